/* SPDX-License-Identifier: Apache-2.0 */
/* The default SDO server (CiA 301, 7.2.4): expedited and segmented transfers, one at a time, no block transfer. */
#ifndef SDO_SERVER_H
#define SDO_SERVER_H

#include <stdbool.h>
#include <stdint.h>

enum { SDO_TIMEOUT_MS = 1000 }; /* a client that falls silent for so long has its transfer aborted */

/* Forgets the transfer that is under way, without a word to the client. */
void sdo_reset(void);

/* Serves one request of eight bytes. Returns whether `response` is to be sent. */
bool sdo_serve(const uint8_t request[8], uint8_t response[8]);

/* Whether a transfer is under way, which sdo_time_out ends; that returns the abort in `response`. */
bool sdo_is_busy(void);
void sdo_time_out(uint8_t response[8]);

#endif
