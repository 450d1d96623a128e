/* Most memory this process has held so far. */
#include <sys/resource.h>

/* In kibibytes. */
long peak_memory(void) {
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
}
