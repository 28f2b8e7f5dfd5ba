/* SPDX-License-Identifier: Apache-2.0 */
/* The object dictionary of the sensor: what sensor.eds describes, as C. */
#ifndef DICTIONARY_H
#define DICTIONARY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { LOCATION_LENGTH = 32 }; /* characters of 2001h:00 */

/* Abort codes of CiA 301, 7.2.4.3.17 */
enum {
  ABORT_NONE = 0,
  ABORT_TOGGLE = 0x05030000,
  ABORT_TIMEOUT = 0x05040000,
  ABORT_COMMAND = 0x05040001,
  ABORT_READ_ONLY = 0x06010002,
  ABORT_NO_OBJECT = 0x06020000,
  ABORT_TOO_LONG = 0x06070012,
  ABORT_TOO_SHORT = 0x06070013,
  ABORT_NO_SUB_INDEX = 0x06090011,
  ABORT_TOO_HIGH = 0x06090031,
  ABORT_TOO_LOW = 0x06090032
};

struct entry {
  uint16_t index;
  uint8_t sub;
  bool text;       /* a VISIBLE_STRING, of any length up to `size` */
  bool writable;
  uint8_t size;    /* in bytes */
  void* value;     /* little-endian numbers: as on the bus */
  uint16_t low, high; /* of a writable number; 0, 0: any value */
};

/* Values after Reset node (all) or Reset communication (1000h to 1FFFh alone). */
void dictionary_reset(bool communication_only);

/* Returns an abort code; on ABORT_NONE *found is the entry. */
uint32_t dictionary_find(uint16_t index, uint8_t sub, const struct entry** found);

size_t dictionary_length(const struct entry* entry);

/* Whether `length` bytes may be written; for a text also fewer. Returns an abort code. */
uint32_t dictionary_check_length(const struct entry* entry, size_t length);

/* Checks and takes the value. Returns an abort code, and changes nothing unless that is ABORT_NONE. */
uint32_t dictionary_write(const struct entry* entry, const uint8_t* data, size_t length);

uint16_t heartbeat_time(void); /* 1017h, in milliseconds; 0: no heartbeat */

#endif
