// SPDX-License-Identifier: Apache-2.0
// Empty on purpose: a target needs a source to have precompiled headers (cmake/conform.cmake).
