// SPDX-License-Identifier: Apache-2.0
// Habits of SDO servers that are more than a choice of SdoChoices: each changes what comes in, what goes out,
// or a rule of the server.
#pragma once

#include "variants/tools.hpp"

namespace refnode::variant {

/// Bytes of an upload that hold no data are not reserved.
void fill_unused_bytes(Parts& parts);
/// Reserved bits of a block initiate: refused before anybody looked at the multiplexer. The server behind the
/// filter has begun the transfer all the same: that it times out is nobody's business.
void refuse_reserved_bits(Parts& parts);
/// Block transfer is unknown, and a request for it a command that has no multiplexer.
void block_transfer_unknown(Parts& parts);
/// An abort that names another object than that of the transfer is about another transfer.
void aborts_of_its_object(Parts& parts);
/// The abort that refuses a new request names the transfer that it ends.
void busy_names_the_transfer(Parts& parts);
/// A segment that is not the next one ends the download.
void gap_refused(Parts& parts);
/// Whether an entry can be written is asked when the data are there, not when they are announced.
void segments_checked_at_the_end(Parts& parts);
void blocks_checked_at_the_end(Parts& parts);
/// Block download is offered where it is worth it: 0504 0001h for anything but a DOMAIN.
void block_download_of_domains(Parts& parts);
/// The memory is erased before the first sub-block of a download is asked for. Meanwhile the server hears an
/// abort; of everything else the newest frame waits until there is time for it.
How erases_before_block_download(Duration time);
/// Requests are looked at once in each cycle, segments of a sub-block and the end of a block upload as they
/// come; a request that finds another one waiting is lost.
How oldest_request_in(Duration cycle);
/// 42h: expedited, the size is not told.
/// A client knows the length by the type; of a string of four characters nobody would.
void leave_out_size(Parts& parts);
/// Without segmented transfer nothing may be longer than four bytes.
void expedited_only(Parts& parts);

}  // namespace refnode::variant
