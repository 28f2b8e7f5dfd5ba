// SPDX-License-Identifier: Apache-2.0
// Catch2 v2 wants one translation unit with its main; v3 brings its own library.
#if !__has_include(<catch2/catch_all.hpp>)
#define CATCH_CONFIG_MAIN
#endif
#include "catch.hpp"
