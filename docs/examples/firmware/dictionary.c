/* SPDX-License-Identifier: Apache-2.0 */
#include "dictionary.h"

#include <string.h>

#if __BYTE_ORDER__ != __ORDER_LITTLE_ENDIAN__
#error "values are kept in the byte order of the bus"
#endif

static uint32_t device_type = 0; /* follows no device profile */
static uint8_t error_register = 0;
static char device_name[] = "Temperature sensor";
static char hardware_version[] = "B2";
static char software_version[] = "1.0.0";
static uint16_t producer_heartbeat_time;
static uint8_t identity_entries = 4;
static uint32_t vendor = 0x00005AFE, product = 0x00000501, revision = 0x00010000, serial = 1;
static uint16_t measuring_interval; /* in milliseconds */
static char location[LOCATION_LENGTH + 1];
static int16_t temperature = 215; /* in tenths of a degree Celsius */

#define NUMBER(index, sub, variable) {index, sub, false, false, sizeof(variable), &(variable), 0, 0}
#define CONSTANT_TEXT(index, variable) {index, 0, true, false, sizeof(variable) - 1, variable, 0, 0}

static const struct entry entries[] = {
    NUMBER(0x1000, 0, device_type),
    NUMBER(0x1001, 0, error_register),
    CONSTANT_TEXT(0x1008, device_name),
    CONSTANT_TEXT(0x1009, hardware_version),
    CONSTANT_TEXT(0x100A, software_version),
    {0x1017, 0, false, true, sizeof producer_heartbeat_time, &producer_heartbeat_time, 0, 0},
    NUMBER(0x1018, 0, identity_entries),
    NUMBER(0x1018, 1, vendor),
    NUMBER(0x1018, 2, product),
    NUMBER(0x1018, 3, revision),
    NUMBER(0x1018, 4, serial),
    {0x2000, 0, false, true, sizeof measuring_interval, &measuring_interval, 10, 10000},
    {0x2001, 0, true, true, LOCATION_LENGTH, location, 0, 0},
    NUMBER(0x2002, 0, temperature),
};

void dictionary_reset(bool communication_only) {
  producer_heartbeat_time = 0;
  if (communication_only) return;
  measuring_interval = 100;
  memset(location, 0, sizeof location);
  strcpy(location, "unknown");
}

uint32_t dictionary_find(uint16_t index, uint8_t sub, const struct entry** found) {
  bool object = false;
  for (size_t i = 0; i < sizeof entries / sizeof *entries; ++i) {
    if (entries[i].index != index) continue;
    object = true;
    if (entries[i].sub != sub) continue;
    *found = &entries[i];
    return ABORT_NONE;
  }
  return object ? ABORT_NO_SUB_INDEX : ABORT_NO_OBJECT;
}

size_t dictionary_length(const struct entry* entry) {
  return entry->text ? strnlen(entry->value, entry->size) : entry->size;
}

uint32_t dictionary_check_length(const struct entry* entry, size_t length) {
  if (length > entry->size) return ABORT_TOO_LONG;
  return length < entry->size && !entry->text ? ABORT_TOO_SHORT : ABORT_NONE;
}

uint32_t dictionary_write(const struct entry* entry, const uint8_t* data, size_t length) {
  const uint32_t wrong = dictionary_check_length(entry, length);
  if (wrong != ABORT_NONE) return wrong;
  if (entry->high != 0) { /* every number with limits is an UNSIGNED16 */
    const uint16_t number = (uint16_t)(data[0] | data[1] << 8);
    if (number > entry->high) return ABORT_TOO_HIGH;
    if (number < entry->low) return ABORT_TOO_LOW;
  }
  memset(entry->value, 0, entry->size);
  memcpy(entry->value, data, length);
  return ABORT_NONE;
}

uint16_t heartbeat_time(void) { return producer_heartbeat_time; }
