// Static libraries of Debian are compiled for programs: they take the place of stderr for known, which
// a library has no right to. The linker hands them this instead (--wrap=stderr).
#include <stdio.h>

extern FILE *__real_stderr;
__attribute__((visibility("hidden"))) FILE *__wrap_stderr;

__attribute__((constructor)) static void set_stderr(void) {
    __wrap_stderr = __real_stderr;
}
