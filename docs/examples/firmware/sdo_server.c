/* SPDX-License-Identifier: Apache-2.0 */
#include "sdo_server.h"

#include <string.h>

#include "dictionary.h"

enum { DOWNLOAD_SEGMENT, INITIATE_DOWNLOAD, INITIATE_UPLOAD, UPLOAD_SEGMENT, ABORT }; /* ccs: bits 7 to 5 */

static enum { IDLE, UPLOADING, DOWNLOADING } state;
static const struct entry* entry;
static uint8_t multiplexer[3]; /* of the transfer, or of the last one */
static uint8_t toggle;         /* expected in the next segment: 00h or 10h */
static uint8_t buffer[LOCATION_LENGTH];
static size_t length, position;
static bool size_indicated;

void sdo_reset(void) { state = IDLE; }

bool sdo_is_busy(void) { return state != IDLE; }

static bool abort_with(uint32_t code, uint8_t response[8]) {
  state = IDLE;
  response[0] = 0x80;
  memcpy(response + 1, multiplexer, sizeof multiplexer);
  memcpy(response + 4, &code, sizeof code);
  return true;
}

void sdo_time_out(uint8_t response[8]) { abort_with(ABORT_TIMEOUT, response); }

/* Puts the object of an initiate request into `entry`. Returns an abort code. */
static uint32_t begin(const uint8_t request[8]) {
  state = IDLE; /* a new transfer takes the place of one that is not finished */
  memcpy(multiplexer, request + 1, sizeof multiplexer);
  return dictionary_find((uint16_t)(request[1] | request[2] << 8), request[3], &entry);
}

static bool initiate_upload(const uint8_t request[8], uint8_t response[8]) {
  const uint32_t wrong = begin(request);
  if (wrong != ABORT_NONE) return abort_with(wrong, response);
  memcpy(response + 1, multiplexer, sizeof multiplexer);
  length = dictionary_length(entry);
  if (length >= 1 && length <= 4) {
    response[0] = (uint8_t)(0x43 | (4 - length) << 2);
    memcpy(response + 4, entry->value, length);
    return true;
  }
  /* A copy, so that a value that changes meanwhile is never sent in two halves. */
  memcpy(buffer, entry->value, length);
  state = UPLOADING;
  position = 0;
  toggle = 0;
  response[0] = 0x41;
  response[4] = (uint8_t)length;
  return true;
}

static bool upload_segment(const uint8_t request[8], uint8_t response[8]) {
  if (state != UPLOADING) return abort_with(ABORT_COMMAND, response);
  if ((request[0] & 0x10) != toggle) return abort_with(ABORT_TOGGLE, response);
  const size_t rest = length - position, count = rest < 7 ? rest : 7;
  const bool last = rest == count;
  response[0] = (uint8_t)(toggle | (7 - count) << 1 | last);
  memcpy(response + 1, buffer + position, count);
  position += count;
  toggle ^= 0x10;
  if (last) state = IDLE;
  return true;
}

static bool initiate_download(const uint8_t request[8], uint8_t response[8]) {
  const bool expedited = request[0] & 0x02;
  size_indicated = request[0] & 0x01;
  uint32_t wrong = begin(request);
  if (wrong == ABORT_NONE && !entry->writable) wrong = ABORT_READ_ONLY;
  if (wrong != ABORT_NONE) return abort_with(wrong, response);
  if (expedited) {
    /* Without a size the number of bytes is that of the object, as far as four bytes go. */
    length = size_indicated ? 4u - (request[0] >> 2 & 3) : entry->size < 4 ? entry->size : 4;
    wrong = dictionary_write(entry, request + 4, length);
  } else if (size_indicated) {
    uint32_t announced;
    memcpy(&announced, request + 4, sizeof announced);
    wrong = dictionary_check_length(entry, announced);
    length = announced;
  }
  if (wrong != ABORT_NONE) return abort_with(wrong, response);
  if (!expedited) {
    state = DOWNLOADING;
    position = 0;
    toggle = 0;
  }
  response[0] = 0x60;
  memcpy(response + 1, multiplexer, sizeof multiplexer);
  return true;
}

static bool download_segment(const uint8_t request[8], uint8_t response[8]) {
  if (state != DOWNLOADING) return abort_with(ABORT_COMMAND, response);
  if ((request[0] & 0x10) != toggle) return abort_with(ABORT_TOGGLE, response);
  const size_t count = 7u - (request[0] >> 1 & 7);
  const size_t most = size_indicated ? length : entry->size;
  if (position + count > most) return abort_with(ABORT_TOO_LONG, response);
  memcpy(buffer + position, request + 1, count);
  position += count;
  response[0] = (uint8_t)(0x20 | toggle);
  toggle ^= 0x10;
  if (!(request[0] & 0x01)) return true;
  const uint32_t wrong = size_indicated && position < length ? (uint32_t)ABORT_TOO_SHORT
                                                             : dictionary_write(entry, buffer, position);
  if (wrong != ABORT_NONE) return abort_with(wrong, response);
  state = IDLE;
  return true;
}

bool sdo_serve(const uint8_t request[8], uint8_t response[8]) {
  memset(response, 0, 8);
  switch (request[0] >> 5) {
    case DOWNLOAD_SEGMENT: return download_segment(request, response);
    case INITIATE_DOWNLOAD: return initiate_download(request, response);
    case INITIATE_UPLOAD: return initiate_upload(request, response);
    case UPLOAD_SEGMENT: return upload_segment(request, response);
    case ABORT: state = IDLE; return false;
    default:
      /* Block transfer among them: the client is to know which object it is about. */
      memcpy(multiplexer, request + 1, sizeof multiplexer);
      return abort_with(ABORT_COMMAND, response);
  }
}
