// SPDX-License-Identifier: Apache-2.0
// Every defect shows on the bus: the same conversation gives another transcript than with a conformant node.
// This keeps rows from outliving the code they switch; which requirement they violate is for the suite to
// prove.
#include <sstream>
#include <string>
#include <vector>

#include "bench.hpp"

using namespace refnode;
using namespace refnode::testing;

namespace {

// Each conversation runs with a fresh node 5. Lines are frames to send, "wait <ms>", "rtr <id> <dlc>", "ext
// <frame>"; "sdo <bytes>" is a request on 605h.
const std::vector<std::string> conversations = {
    // Reading everything the description lists, and some more.
    "read 0000 00\nread 0260 00\nread 0800 00\nread 0FFF 00\nread 1004 00\nread 1004 01\nread 1000 00\nread 1000 01\n"
    "read 1001 00\nread 1002 00\nread 1003 00\nread 1003 01\nread 1005 00\nread 1006 00\nread 1007 00\nread 1008 00\n"
    "read 1009 00\nread 100A 00\nread 1010 00\nread 1010 01\nread 1010 02\nread 1010 80\nread 1011 00\nread 1011 01\n"
    "read 1011 80\nread 1012 00\nread 1014 00\nread 1015 00\nread 1016 00\nread 1016 01\nread 1016 03\nread 1016 05\n"
    "read 1017 00\nread 1018 00\nread 1018 01\nread 1018 02\nread 1018 03\nread 1018 04\nread 1018 05\nread 1020 00\n"
    "read 1200 00\nread 1200 01\nread 1200 02\nread 1400 00\nread 1400 01\nread 1400 02\nread 1400 03\nread 1400 04\n"
    "read 1400 05\nread 1400 06\nread 1600 00\nread 1600 01\nread 1600 41\nread 1800 00\nread 1800 01\nread 1800 02\n"
    "read 1800 04\nread 1800 05\nread 1A00 00\nread 1A00 01\nread 1A00 41\nread 2007 00\nread 2001 02\nread 5FFE 00\n"
    "read 6207 01\nread A480 00\nread D000 00\nread FFFF 00\nread 2000 15\n",
    // Data type entries and the structure of objects.
    "read 0001 00\nread 0003 00\nread 0005 00\nread 0007 00\nread 0007 01\nread 0009 00\nread 000C 00\nread 0011 00\n"
    "read 0017 00\nread 0020 00\nread 0020 03\nread 0021 00\nread 0021 01\nread 0022 00\nread 0023 00\nread 0023 04\n"
    "read 0026 00\nread 0040 00\nread 0040 01\nread 0060 00\nread 1018 FF\nsdo 23 07 00 00 08 00 00 00\n"
    "sdo 23 18 10 FF 00 00 00 00\nread 1018 FF\nread 2002 01\nread 2000 10\n",
    // Writing what must not be written.
    "sdo 23 00 10 00 91 01 0F 00\nsdo 2F 01 10 00 00 00 00 00\nsdo 23 02 10 00 00 00 00 00\nsdo 23 08 10 00 54 45 53 54\n"
    "sdo 23 09 10 00 54 45 53 54\nsdo 23 0A 10 00 54 45 53 54\nsdo 2F 10 10 00 01 00 00 00\nsdo 2F 11 10 00 01 00 00 00\n"
    "sdo 2F 16 10 00 01 00 00 00\nsdo 2F 18 10 00 04 00 00 00\nsdo 23 18 10 01 78 56 34 12\nsdo 23 18 10 04 78 56 34 12\n"
    "sdo 23 18 10 05 00 00 00 00\nsdo 2F 00 12 00 02 00 00 00\nsdo 23 00 12 01 B0 06 00 80\nsdo 2F 00 14 00 02 00 00 00\n"
    "sdo 2F 00 18 00 02 00 00 00\nsdo 23 03 10 01 00 00 00 00\nsdo 2F 04 10 00 00 00 00 00\n"
    "sdo 21 00 10 00 04 00 00 00\nsdo 07 01 02 03 04 00 00 00\n",
    // Writing what can be written, right and wrong.
    "sdo 2B 17 10 00 E8 03 00 00\nread 1017 00\nsdo 23 17 10 00 E8 03 00 00\nsdo 2F 17 10 00 01 00 00 00\n"
    "sdo 22 17 10 00 D0 07 00 00\nsdo 23 06 10 00 10 27 00 00\nread 1006 00\nsdo 23 07 10 00 88 13 00 00\n"
    "sdo 2B 15 10 00 E8 03 00 00\nsdo 23 07 20 00 01 00 00 00\nsdo 2F 02 20 01 C9 00 00 00\nread 2002 01\n"
    "sdo 2F 02 20 01 C8 00 00 00\nsdo 2F 02 20 01 09 00 00 00\nsdo 2F 00 14 02 01 00 00 00\nsdo 2F 00 18 02 01 00 00 00\n"
    "sdo 2F 00 14 02 F1 00 00 00\nsdo 2F 00 18 02 F1 00 00 00\nsdo 2B 00 14 03 E8 03 00 00\nsdo 2B 00 18 03 E8 03 00 00\n"
    "605: 2B 17 10 00 E8\nread 1017 00\nsdo 23 05 10 00 A0 06 00 00\nread 1005 00\nsdo 23 12 10 00 A0 06 00 00\nread 1012 00\n",
    // Segmented transfers.
    "sdo 40 08 10 00 00 00 00 00\nsdo 70 00 00 00 00 00 00 00\nsdo 60 00 00 00 00 00 00 00\nsdo 70 00 00 00 00 00 00 00\n"
    "sdo 60 00 00 00 00 00 00 00\nsdo 40 08 10 00 00 00 00 00\nsdo 60 00 00 00 00 00 00 00\nsdo 70 00 00 00 00 00 00 00\n"
    "sdo 60 00 00 00 00 00 00 00\nsdo 70 00 00 00 00 00 00 00\nsdo 60 00 00 00 00 00 00 00\n",
    "sdo 40 08 10 00 00 00 00 00\nsdo 80 08 10 00 00 00 00 08\nsdo 60 00 00 00 00 00 00 00\nsdo 40 08 10 00 00 00 00 00\n"
    "sdo 40 00 10 00 00 00 00 00\nsdo 40 08 10 00 00 00 00 00\n000: 82 05\nwait 100\nsdo 60 00 00 00 00 00 00 00\n",
    "sdo 21 06 20 00 09 00 00 00\nsdo 00 41 42 43 44 45 46 47\nsdo 1B 48 49 00 00 00 00 00\nread 2006 00\n"
    "sdo 21 17 10 00 02 00 00 00\nsdo 1B E8 03 00 00 00 00 00\nsdo 21 17 10 00 02 00 00 00\nsdo 0D E8 00 00 00 00 00 00\n"
    "sdo 21 17 10 00 02 00 00 00\nsdo 09 E8 03 01 00 00 00 00\nsdo E0 00 10 00 00 00 00 00\n",
    // Uploads out of the ordinary.
    "read 2000 16\nread 2001 04\nread 2001 04\nread 2005 01\nread 2005 08\nread 2000 0F\n"
    "read 2004 02\nsdo 40 00 10 00 FF FF FF FF\nsdo 41 00 10 00 00 00 00 00\n"
    "sdo 40 06 20 00 00 00 00 00\nsdo 60 FF FF FF FF FF FF FF\nsdo 7F 00 00 00 00 00 00 00\n"
    "615: 40 00 10 00 00 00 00 00\nsdo 81 00 10 00 00 00 00 08\nread 1000 00\n",
    "sdo 40 08 10 00 00 00 00 00\nsdo 2B 17 10 00 E8 03 00 00\nread 1017 00\n"
    "sdo 40 08 10 00 00 00 00 00\nsdo 01 00 00 00 00 00 00 00\nsdo 40 08 10 00 00 00 00 00\n"
    "000: 01 05\nsdo 60 00 00 00 00 00 00 00\nsdo 40 08 10 00 00 00 00 00\n000: 80 05\n"
    "sdo 60 00 00 00 00 00 00 00\n",
    "sdo 40 08 10 00 00 00 00 00\n605: 60\nsdo 60 00 00 00 00 00 00 00\nsdo 40 08 10 00 00 00 00 00\n"
    "606: 40 00 10 00 00 00 00 00\nsdo 60 00 00 00 00 00 00 00\nsdo 40 08 10 00 00 00 00 00\n"
    "586: 43 00 10 00 00 00 00 00\nsdo 60 00 00 00 00 00 00 00\nsdo 40 08 10 00 00 00 00 00\n"
    "706: 05\nsdo 60 00 00 00 00 00 00 00\n",
    "sdo 40 08 10 00 00 00 00 00\nwait 1800\nread 1000 00\nwait 1800\nsdo 21 06 20 00 09 00 00 00\n"
    "wait 1800\nread 1000 00\n",
    "sdo 40 08 10 00 00 00 00 00\n000: 02 05\nread 1000 00\n000: 80 05\nwait 10\nread 1000 00\n",
    "sdo A0 08 10 00 7F 00 00 00\nsdo A3 00 00 00 00 00 00 00\n",
    // Downloads out of the ordinary.
    "sdo 2F 00 20 05 55 00 00 00\nread 2000 05\nsdo 2B 00 20 06 55 AA 00 00\nread 2000 06\n"
    "sdo 27 00 20 16 01 02 03 00\nread 2000 16\nsdo 23 00 20 07 01 02 03 04\nread 2000 07\n"
    "sdo 27 00 20 06 01 02 03 00\nsdo 2B 00 20 06 66 77 FF FF\nread 2000 06\n"
    "sdo 3B 00 20 06 88 99 00 00\nread 2000 06\n",
    "sdo 20 00 20 06 00 00 00 00\nsdo 0B 34 12 00 00 00 00 00\nsdo 20 00 20 06 00 00 00 00\n"
    "sdo 0F 00 00 00 00 00 00 00\nsdo 21 06 20 00 00 00 00 00\nsdo 0F 00 00 00 00 00 00 00\n"
    "sdo 21 00 20 06 02 00 00 00\nsdo 60 00 00 00 00 00 00 00\nsdo 21 00 20 06 02 00 00 00\n"
    "sdo 2B 00 20 06 77 66 00 00\nsdo 21 FF FF 00 04 00 00 00\nsdo 21 00 10 01 04 00 00 00\n",
    "sdo 21 06 20 00 09 00 00 00\nsdo 00 41 42 43 44 45 46 47\nsdo 80 06 20 00 00 00 00 08\n"
    "read 2006 00\nsdo 21 00 20 06 02 00 00 00\nsdo 0B 55 AA FF FF FF FF FF\nread 2000 06\n"
    "sdo 21 06 20 00 0B 00 00 00\nsdo 06 41 42 43 44 00 00 00\nsdo 11 45 46 47 48 49 4A 4B\n"
    "read 2006 00\nsdo 21 06 20 00 07 00 00 00\nsdo 01 41 42 43 44 45 46 47\nread 2006 00\n"
    "sdo 2B 00 20 06 77 66 00 00\nsdo 21 06 20 00 09 00 00 00\nsdo 00 41 42 43 44 45 46 47\n"
    "sdo 1B 48 49 00 00 00 00 00\n",
    // Addressing and formats.
    "606: 40 00 10 00 00 00 00 00\n600: 40 00 10 00 00 00 00 00\n585: 40 00 10 00 00 00 00 00\nrtr 605 8\n"
    "ext 605: 40 00 10 00 00 00 00 00\n",
    // States.
    "000: 01 05\nread 1000 00\nread 1018 00\nsdo 23 00 10 00 91 01 0F 00\n000: 02 05\nread 1000 00\n000: 80 05\n000: 82 05\n"
    "read 1000 00\nwait 100\nread 1000 00\n",
    "sdo 2B 17 10 00 64 00 00 00\nwait 250\n000: 01 05\nwait 250\n000: 02 05\nwait 250\n000: 01 05\nwait 250\n000: 80 05\n"
    "wait 250\n000: 80 05\nwait 100\n000: 02 05\nwait 100\n000: 80 05\nwait 100\nsdo 2B 17 10 00 00 00 00 00\nwait 500\n"
    "000: 01 05\nwait 50\n",
    "sdo 2B 17 10 00 64 00 00 00\n000: 01 00\nwait 100\n000: 80 00\n000: 01 06\nwait 100\n000: 80 05\n000: 01 85\nwait 100\n"
    "000: 80 05\n000: 01\nwait 100\n000: 80 05\n000: 01 05 00\nwait 100\n000: 80 05\n000: 03 05\nwait 100\n000: 02 05\n"
    "000: 82 05\nwait 100\n000: 82 05\nwait 1\n000: 82 05\nwait 100\n",
    // Resets and storage.
    "sdo 2B 17 10 00 D0 07 00 00\nsdo 2F 06 62 01 00 00 00 00\n000: 82 05\nwait 100\nread 1017 00\nread 6206 01\n"
    "sdo 2B 17 10 00 D0 07 00 00\n000: 81 05\nwait 100\nread 1017 00\nread 6206 01\n",
    "sdo 2B 17 10 00 D0 07 00 00\nsdo 2F 06 62 01 00 00 00 00\nsdo 23 10 10 01 65 76 61 73\nsdo 23 10 10 01 53 41 56 45\n"
    "sdo 23 10 10 01 00 00 00 00\n000: 81 05\nwait 100\nread 1017 00\nsdo 2B 17 10 00 D0 07 00 00\n"
    "sdo 23 10 10 01 73 61 76 65\n000: 81 05\nwait 3000\nread 1017 00\nsdo 23 11 10 01 00 00 00 00\nsdo 23 11 10 01 4C 4F 41 44\n"
    "sdo 23 11 10 01 64 61 6F 6C\n000: 81 05\nwait 100\nread 1017 00\nsdo 23 11 10 01 6C 6F 61 64\nread 1017 00\n000: 81 05\n"
    "wait 100\nread 1017 00\n",
    "sdo 2B 17 10 00 D0 07 00 00\nsdo 2F 06 62 01 00 00 00 00\nsdo 23 10 10 02 73 61 76 65\n000: 81 05\nwait 100\nread 1017 00\n"
    "read 6206 01\nsdo 23 11 10 02 6C 6F 61 64\n000: 82 05\nwait 100\nread 1017 00\n",
    "sdo 2B 17 10 00 D0 07 00 00\nsdo 2F 06 62 01 00 00 00 00\nsdo 23 10 10 03 73 61 76 65\n000: 81 05\nwait 100\nread 1017 00\n"
    "read 6206 01\nsdo 23 11 10 03 6C 6F 61 64\n000: 81 05\nwait 100\nread 6206 01\n",
    "sdo 2F 06 62 01 00 00 00 00\nsdo 23 10 10 01 73 61 76 65\nsdo 23 11 10 02 6C 6F 61 64\n000: 81 05\nwait 100\nread 6206 01\n",
    "sdo 2F 20 2F 00 01 00 00 00\nsdo 23 10 10 01 73 61 76 65\nsdo 23 11 10 01 6C 6F 61 64\n",
    // Errors and history.
    "sdo 2F 03 10 00 01 00 00 00\nsdo 2B 00 2F 01 10 42 00 00\nread 1001 00\nread 1003 00\nread 1003 01\nsdo 2F 03 10 00 01 00 00 00\n"
    "read 1003 00\nsdo 2B 00 2F 01 10 23 00 00\nread 1003 01\nread 1003 02\nsdo 2B 00 2F 02 10 42 00 00\nsdo 2B 00 2F 02 10 23 00 00\n"
    "read 1001 00\nread 1003 00\nsdo 2B 00 2F 01 10 42 00 00\nsdo 2F 03 10 00 00 00 00 00\nread 1003 00\nread 1003 01\nread 1001 00\n",
    "sdo 2B 00 2F 01 01 50 00 00\nsdo 2B 00 2F 01 02 50 00 00\nsdo 2B 00 2F 01 03 50 00 00\nsdo 2B 00 2F 01 04 50 00 00\n"
    "sdo 2B 00 2F 01 05 50 00 00\nsdo 2B 00 2F 01 06 50 00 00\nsdo 2B 00 2F 01 07 50 00 00\nsdo 2B 00 2F 01 08 50 00 00\n"
    "sdo 2B 00 2F 01 09 50 00 00\nread 1003 00\nread 1003 01\nread 1003 08\n",
    "sdo 2B 15 10 00 88 13 00 00\nsdo 2B 00 2F 01 10 42 00 00\nsdo 2B 00 2F 01 10 23 00 00\nwait 1000\n",
    "sdo 23 14 10 00 85 00 00 80\nsdo 2B 00 2F 01 10 42 00 00\nsdo 23 14 10 00 A0 06 00 80\nsdo 23 14 10 00 A0 06 00 00\n"
    "sdo 2B 00 2F 01 10 23 00 00\n080: 01\n080:\n",
    // Heartbeat consumer.
    "sdo 23 16 10 01 64 00 7E 00\nwait 500\n77E: 05\nwait 60\n77E: 05\nwait 60\n77D: 05\nwait 60\n77D: 05\nwait 200\n77E: 05\nread 1001 00\n",
    "sdo 23 16 10 01 E8 03 7E 00\nread 1016 01\nsdo 23 16 10 02 D0 07 7E 00\nsdo 23 16 10 02 00 00 7E 00\nsdo 23 16 10 01 D0 07 7E 00\n"
    "sdo 23 16 10 01 E8 03 7E 01\nsdo 2B 17 10 00 64 00 00 00\nsdo 23 16 10 01 64 00 7E 00\n000: 01 05\n77E: 05\nwait 250\n000: 02 05\n77E: 05\nwait 250\n",
    "sdo 23 16 10 02 64 00 7E 00\n77E: 05\nwait 250\n",
    "sdo 23 16 10 01 00 00 7E 00\n77E: 05\nwait 250\n000: 01 05\n000: 81 05\nwait 100\nsdo 01 00 00 00 00 00 00 00\n",
    // COB-IDs.
    "sdo 23 05 10 00 80 00 00 40\nsdo 23 05 10 00 80 00 00 20\nsdo 23 05 10 00 80 00 00 80\nsdo 23 05 10 00 80 08 00 00\n"
    "sdo 23 05 10 00 01 00 00 00\nsdo 23 05 10 00 A0 06 00 00\n080: 01\n6A0: 01\n",
    "sdo 23 12 10 00 00 01 00 40\nsdo 23 12 10 00 00 01 00 20\nsdo 23 12 10 00 01 00 00 00\nsdo 23 12 10 00 A0 06 00 00\n"
    "sdo 23 12 10 00 A0 06 00 80\nsdo 23 12 10 00 A1 06 00 80\n6A0: 00 36 6E F1 10 27\nread 2F10 00\n",
    "100: 00 36 6E 01 10 27\nread 2F10 00\n",
    "sdo 23 14 10 00 A0 06 00 00\nsdo 23 14 10 00 85 00 00 00\nsdo 23 14 10 00 85 00 00 80\nsdo 23 14 10 00 85 00 00 A0\n"
    "sdo 23 14 10 00 85 00 00 C0\nsdo 23 14 10 00 85 08 00 80\nsdo 23 14 10 00 01 00 00 00\n",
    "sdo 23 00 14 01 A0 06 00 00\nsdo 23 00 14 01 05 02 00 80\nsdo 23 00 14 01 05 02 00 A0\nsdo 23 00 14 01 01 00 00 00\n"
    "sdo 23 00 14 01 A0 06 00 80\n000: 01 05\n205: 01 02 03 04\n6A0: 05 06 07 08\nread 6200 01\nsdo 23 00 14 01 A0 06 00 00\n6A0: 09 0A 0B 0C\nread 6200 01\n",
    "sdo 23 00 18 01 A0 06 00 40\nsdo 23 00 18 01 85 01 00 C0\nsdo 23 00 18 01 85 01 00 E0\nsdo 23 00 18 01 85 09 00 C0\n"
    "sdo 23 00 18 01 01 00 00 40\nsdo 23 00 18 01 A0 06 00 C0\n000: 01 05\nsdo 2F 00 62 01 01 00 00 00\nsdo 23 00 18 01 A0 06 00 40\n"
    "sdo 2F 00 62 01 02 00 00 00\nrtr 6A0 4\n",
    // PDO traffic and mapping.
    "205: 01 02 03 04\nread 6200 01\n000: 01 05\n205: 01 02 03\nread 6200 01\n205: 01 02 03 04 05\nread 6200 01\n205: 11 22 33 44\n"
    "read 6411 01\nsdo 2F 00 14 02 01 00 00 00\n205: 55 66 77 88\nread 6200 01\n080:\nread 6200 01\n",
    "sdo 2F 00 18 02 02 00 00 00\nsdo 2B 00 18 05 64 00 00 00\n080:\n080:\n000: 01 05\n080:\n080:\n080:\nwait 250\n"
    "sdo 2F 00 18 02 00 00 00 00\n080:\nsdo 2F 00 18 02 FC 00 00 00\n080:\nsdo 2F 00 18 02 FF 00 00 00\nwait 250\n",
    "sdo 23 00 18 01 85 01 00 C0\nsdo 2B 00 18 03 E8 03 00 00\nsdo 23 00 18 01 85 01 00 40\n000: 01 05\n605: 2F 00 62 01 01 00 00 00\n"
    "605: 2F 00 62 01 02 00 00 00\nwait 300\n",
    "sdo 2F 00 16 00 00 00 00 00\nsdo 23 00 14 01 05 02 00 80\nsdo 23 00 16 01 10 02 11 64\nsdo 2F 00 16 00 00 00 00 00\n"
    "sdo 23 00 16 01 08 00 FF 5F\nsdo 23 00 16 01 20 00 00 10\nsdo 23 00 16 01 10 01 00 62\nsdo 23 00 16 01 20 00 07 00\n"
    "sdo 23 00 16 02 20 00 07 00\nsdo 23 00 16 03 20 00 07 00\nsdo 2F 00 16 00 03 00 00 00\nsdo 2F 00 16 00 41 00 00 00\n",
    "sdo 2F 00 1A 00 00 00 00 00\nsdo 23 00 18 01 85 01 00 C0\nsdo 23 00 1A 01 10 02 01 64\nsdo 2F 00 1A 00 00 00 00 00\n"
    "sdo 23 00 1A 01 08 00 FF 5F\nsdo 23 00 1A 01 20 00 00 10\nsdo 23 00 1A 01 10 01 00 60\nsdo 23 00 1A 01 10 01 01 64\n"
    "sdo 23 00 1A 02 10 01 01 64\nsdo 23 00 1A 03 10 01 01 64\nsdo 23 00 1A 04 10 01 01 64\nsdo 23 00 1A 05 10 01 01 64\n"
    "sdo 2F 00 1A 00 05 00 00 00\nsdo 2F 00 1A 00 41 00 00 00\n",
};

/// A memory that fails when the defect is about failures.
class BrokenStorage final : public Storage {
  conform::Result<void> write(const Images&) override { return conform::fail("broken"); }
};

std::string transcript(const std::vector<std::string>& defects) {
  std::string all;
  const auto note = [&](const Frames& frames) {
    for (const auto& frame : frames) all += frame + "\n";
    all += ".\n";
  };
  for (const std::string& conversation : conversations) {
    Bench bench(defects);
    note(bench.wait(100ms, true));
    for (const auto line : conform::split(conversation, '\n')) {
      std::istringstream words{std::string(line)};
      std::string verb;
      words >> verb;
      if (verb.empty()) continue;
      if (verb == "wait") {
        int ms = 0;
        words >> ms;
        note(bench.wait(std::chrono::milliseconds(ms), true));
      } else if (verb == "rtr") {
        std::uint32_t id = 0;
        int dlc = 0;
        words >> std::hex >> id >> dlc;
        bench.send(conform::can::remote_frame(conform::CanId(id), static_cast<std::uint8_t>(dlc)));
        note(bench.take());
      } else if (verb == "ext") {
        bench.send_extended(line.substr(4));
        note(bench.take());
      } else if (verb == "sdo") {
        note(bench.send("605: " + std::string(line.substr(4))));
        note(bench.wait(200ms, true));
      } else if (verb == "read") {
        std::string index, sub;
        words >> index >> sub;
        std::string answer =
            bench.sdo("40 " + index.substr(2) + " " + index.substr(0, 2) + " " + sub + " 00 00 00 00");
        note({answer});
        for (int toggle = 0; answer.starts_with("41") || answer.starts_with("00") || answer.starts_with("10");
             toggle ^= 1) {
          answer = bench.sdo(toggle == 0 ? "60 00 00 00 00 00 00 00" : "70 00 00 00 00 00 00 00");
          note({answer});
        }
        note(bench.wait(200ms, true));
      } else {
        note(bench.send(line));
      }
    }
  }
  Bench broken(defects, std::make_shared<BrokenStorage>());
  broken.wait(100ms);
  note({broken.sdo("23 10 10 01 73 61 76 65")});
  Bench busy(defects);
  busy.wait(100ms);
  for (int i = 0; i < 160; ++i) note({busy.sdo("40 00 10 00 00 00 00 00")});
  return all;
}

}  // namespace

TEST_CASE("Every defect changes what is seen on the bus") {
  const std::string conformant = transcript({});
  const bool reproducible = transcript({}) == conformant;
  CHECK(reproducible);
  for (const Defect& row : defects()) {
    INFO(row.id);
    const bool visible = transcript({std::string(row.id)}) != conformant;
    CHECK(visible);
  }
}
