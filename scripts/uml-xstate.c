// SPDX-License-Identifier: Apache-2.0
//
// Lets linux.uml run on processors with AMX; scripts/with-vcan builds and preloads it there.
//
// User-mode Linux keeps the extended processor state of its processes in a buffer of 2696 bytes, made for
// AVX-512. With AMX the state is larger, and the host's kernel takes a whole one only (PTRACE_SETREGSET,
// NT_X86_XSTATE), so that the guest dies with its first process. Here the missing rest, which nobody in the
// guest uses, is filled up with what the process has.
#include <elf.h>
#include <stdarg.h>
#include <string.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

// <sys/ptrace.h> would declare ptrace() with types of its own.
enum { peek_first = 1, peek_last = 3, get_register_set = 0x4204, set_register_set = 0x4205 };

long ptrace(int request, ...) {
  va_list arguments;
  va_start(arguments, request);
  const long process = va_arg(arguments, long);
  void* const address = va_arg(arguments, void*);
  void* const data = va_arg(arguments, void*);
  va_end(arguments);

  static char whole[64 * 1024];
  const struct iovec* const part = data;
  struct iovec all = {whole, sizeof whole};
  if (request == set_register_set && address == (void*)NT_X86_XSTATE &&
      syscall(SYS_ptrace, get_register_set, process, address, &all) == 0 && all.iov_len > part->iov_len) {
    memcpy(whole, part->iov_base, part->iov_len);
    return syscall(SYS_ptrace, set_register_set, process, address, &all);
  }
  if (request >= peek_first && request <= peek_last) {  // the C library returns the word
    long word = 0;
    const long result = syscall(SYS_ptrace, request, process, address, &word);
    return result < 0 ? result : word;
  }
  return syscall(SYS_ptrace, request, process, address, data);
}
