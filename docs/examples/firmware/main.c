/* SPDX-License-Identifier: Apache-2.0 */
/* A CANopen temperature sensor on SocketCAN: boot-up, NMT slave, heartbeat producer, SDO server.
 * Usage: sensor INTERFACE NODE-ID */
#include <errno.h>
#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

#include "dictionary.h"
#include "sdo_server.h"

enum { BOOT_UP = 0x00, STOPPED = 0x04, OPERATIONAL = 0x05, PRE_OPERATIONAL = 0x7F }; /* CiA 301, 7.2.8.3.2.2 */
enum { NMT_START = 1, NMT_STOP = 2, NMT_PRE_OPERATIONAL = 128, NMT_RESET_NODE = 129, NMT_RESET_COMMUNICATION = 130 };

static int bus;
static uint8_t node_id;
static uint8_t nmt_state;
static int64_t next_heartbeat;         /* in milliseconds; looked at while heartbeat_time() is not 0 */
static int64_t transfer_ends;          /* looked at while an SDO transfer is under way */
static uint16_t current_heartbeat_time;

static int64_t now(void) {
  struct timespec time;
  clock_gettime(CLOCK_MONOTONIC, &time);
  return (int64_t)time.tv_sec * 1000 + time.tv_nsec / 1000000;
}

static void send_frame(uint32_t id, const uint8_t* data, uint8_t length) {
  struct can_frame frame = {.can_id = id, .can_dlc = length};
  memcpy(frame.data, data, length);
  while (write(bus, &frame, sizeof frame) < 0) {
    struct pollfd room = {.fd = bus, .events = POLLOUT};
    if (errno != ENOBUFS && errno != EINTR) {
      perror("sensor: write");
      exit(EXIT_FAILURE);
    }
    poll(&room, 1, 1); /* the queue of the interface is full: poll does not wait for that, its time does */
  }
}

static void send_error_control(uint8_t state) { send_frame(0x700u + node_id, &state, 1); }

static void reset(bool communication_only) {
  dictionary_reset(communication_only);
  sdo_reset();
  current_heartbeat_time = heartbeat_time();
  send_error_control(BOOT_UP);
  nmt_state = PRE_OPERATIONAL;
}

static void take_nmt_command(uint8_t command) {
  switch (command) {
    case NMT_START: nmt_state = OPERATIONAL; break;
    case NMT_STOP:
      nmt_state = STOPPED;
      sdo_reset();
      break;
    case NMT_PRE_OPERATIONAL: nmt_state = PRE_OPERATIONAL; break;
    case NMT_RESET_NODE: reset(false); break;
    case NMT_RESET_COMMUNICATION: reset(true); break;
    default: break;
  }
}

static void take_frame(const struct can_frame* frame) {
  uint8_t response[8];
  if (frame->can_id == 0 && frame->can_dlc == 2 && (frame->data[1] == 0 || frame->data[1] == node_id)) {
    take_nmt_command(frame->data[0]);
  } else if (frame->can_id == 0x600u + node_id && frame->can_dlc == 8 && nmt_state != STOPPED) {
    if (sdo_serve(frame->data, response)) send_frame(0x580u + node_id, response, 8);
    transfer_ends = now() + SDO_TIMEOUT_MS;
  }
  if (current_heartbeat_time != heartbeat_time()) { /* was written: the new period begins here */
    current_heartbeat_time = heartbeat_time();
    next_heartbeat = now() + current_heartbeat_time;
  }
}

/* Does what is due and returns how many milliseconds there is nothing to do, -1 for ever. */
static int take_time(void) {
  int64_t next = INT64_MAX;
  uint8_t response[8];
  const int64_t time = now();
  if (current_heartbeat_time != 0) {
    if (time >= next_heartbeat) {
      send_error_control(nmt_state);
      next_heartbeat += current_heartbeat_time;
      if (next_heartbeat <= time) next_heartbeat = time + current_heartbeat_time; /* was kept waiting */
    }
    next = next_heartbeat;
  }
  if (sdo_is_busy() && time >= transfer_ends) {
    sdo_time_out(response);
    send_frame(0x580u + node_id, response, 8);
  }
  if (sdo_is_busy() && transfer_ends < next) next = transfer_ends;
  return next == INT64_MAX ? -1 : (int)(next - time);
}

static bool open_bus(const char* interface) {
  struct sockaddr_can address = {.can_family = AF_CAN, .can_ifindex = (int)if_nametoindex(interface)};
  /* Base frames that are no remote frames. */
  const struct can_filter filters[] = {
      {.can_id = 0, .can_mask = CAN_EFF_FLAG | CAN_RTR_FLAG | CAN_SFF_MASK},
      {.can_id = 0x600u + node_id, .can_mask = CAN_EFF_FLAG | CAN_RTR_FLAG | CAN_SFF_MASK}};
  if (address.can_ifindex == 0) return false;
  bus = socket(PF_CAN, SOCK_RAW, CAN_RAW);
  return bus >= 0 && setsockopt(bus, SOL_CAN_RAW, CAN_RAW_FILTER, filters, sizeof filters) == 0 &&
         bind(bus, (const struct sockaddr*)&address, sizeof address) == 0;
}

int main(int count, char** arguments) {
  const int id = count == 3 ? atoi(arguments[2]) : 0;
  if (id < 1 || id > 127) {
    fputs("usage: sensor INTERFACE NODE-ID (1 to 127)\n", stderr);
    return 2;
  }
  node_id = (uint8_t)id;
  if (!open_bus(arguments[1])) {
    fprintf(stderr, "sensor: %s: %s\n", arguments[1], strerror(errno));
    return EXIT_FAILURE;
  }
  reset(false);
  for (;;) {
    struct pollfd waiting = {.fd = bus, .events = POLLIN};
    struct can_frame frame;
    const int ready = poll(&waiting, 1, take_time());
    if (ready > 0 && read(bus, &frame, sizeof frame) == sizeof frame) {
      take_frame(&frame);
    } else if (ready > 0 && errno != EINTR) {
      perror("sensor: read");
      return EXIT_FAILURE;
    }
  }
}
