// Says so, instead of dying by SIGILL, where the processor lacks the instructions that the rest of
// the program is built with. This file alone is compiled for every x86-64 processor, so it includes
// no header with inline code and calls nothing of the program. Priority 101 is the first that a
// program may use: the check comes before any static initialiser.

#if defined(__x86_64__) && defined(VITRUVIA_NEEDED_PROCESSOR)

extern "C" {
long write(int descriptor, const void* text, unsigned long size);
[[noreturn]] void _exit(int code);
}

namespace {

constexpr int kStandardError = 2;
constexpr int kUnsupportedProcessor = 9;  // core/error.h
constexpr char kMessage[] =
    "vitruvia: this processor lacks instructions of " VITRUVIA_NEEDED_PROCESSOR
    " (such as AVX2) that this program is built with; build it with cmake "
    "-DVITRUVIA_ARCH=x86-64 for any processor\n";

__attribute__((constructor(101))) void RequireProcessor() {
  __builtin_cpu_init();
  if (__builtin_cpu_supports(VITRUVIA_NEEDED_PROCESSOR)) return;
  if (write(kStandardError, kMessage, sizeof(kMessage) - 1) < 0) _exit(kUnsupportedProcessor);
  _exit(kUnsupportedProcessor);
}

}  // namespace

#endif
