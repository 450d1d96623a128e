/* The layout of struct stat is known to C alone. */
#include <sys/stat.h>

/* Number of the file that has this path, 0 where there is none. */
long long number_of_file(const char *path)
{
    struct stat found;
    return stat(path, &found) == 0 ? (long long)found.st_ino : 0;
}
