/* SPDX-License-Identifier: BSD-3-Clause */
/* What memory this process has. */
#include <stdio.h>
#include <sys/resource.h>
#include <unistd.h>

/* Most memory that it has held so far, in kibibytes. */
long peak_memory(void) {
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
}

/* Let it take this number of bytes beside what it has, or without limit if they are negative. Returns 1 if
   that could be set. The address sanitizer takes far more than any limit. */
int limit_memory(long more) {
#ifdef __SANITIZE_ADDRESS__
    (void)more;
    return 0;
#else
    struct rlimit limit;
    long pages = 0;
    FILE *file = fopen("/proc/self/statm", "r");
    int found = file && fscanf(file, "%ld", &pages) == 1;
    if (file) fclose(file);
    if (!found || getrlimit(RLIMIT_AS, &limit)) return 0;
    limit.rlim_cur = more < 0 ? limit.rlim_max : (rlim_t)(pages * sysconf(_SC_PAGESIZE) + more);
    return setrlimit(RLIMIT_AS, &limit) == 0;
#endif
}
