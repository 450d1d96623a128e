/* SPDX-License-Identifier: BSD-3-Clause */
/* What C alone knows of files that appear only when they are complete (unfinished_file.f90). `why` says why something
   failed; it is empty if nothing did. */
#define _POSIX_C_SOURCE 200809L
#include <errno.h>
#include <fcntl.h>
#include <glob.h>
#include <libgen.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Letters of `why`; bytes that a library writes at once, at most: the largest chunk of NetCDF. */
enum { letters = 256, longest_write = 1 << 24 };

static void explain(int failed, char *why)
{
    snprintf(why, letters, "%s", failed ? strerror(errno) : "");
}

/* Whether a file can be made at a path, or replaced there. */
void file_check(const char *path, char *why)
{
    struct stat found;
    char folder[PATH_MAX];
    snprintf(folder, sizeof folder, "%s", path);
    explain(access(dirname(folder), W_OK | X_OK) != 0, why);
    if (lstat(path, &found) == 0 && !S_ISREG(found.st_mode))
        snprintf(why, letters, "a folder, a device or a link is there; expected a file, or nothing");
}

/* Remove what other runs left or write of `path`, and create the unfinished file `part`. */
void file_begin(const char *path, const char *part, char *why)
{
    glob_t left;
    char pattern[2 * PATH_MAX + 8], *end = pattern;
    for (; *path && end < pattern + 2 * PATH_MAX; *end++ = *path++)
        if (strchr("*?[\\", *path))
            *end++ = '\\';
    strcpy(end, ".*.part");
    if (glob(pattern, GLOB_NOSORT, NULL, &left) == 0) {
        for (size_t i = 0; i < left.gl_pathc; i++)
            unlink(left.gl_pathv[i]);
        globfree(&left);
    }
    int file = open(part, O_WRONLY | O_CREAT | O_EXCL, 0666);
    explain(file < 0, why);
    close(file);
}

/* What the system says when a file is to become longer. */
void file_room(const char *part, char *why)
{
    int file = open(part, O_WRONLY);
    errno = posix_fallocate(file, lseek(file, 0, SEEK_END), longest_write);
    explain(errno != 0, why);
    close(file);
}

/* Write text to the unfinished file, and give it its name once it is on the disk, where it outlasts a loss of power. */
void file_publish(const char *part, const char *path, const char *content, size_t length, char *why)
{
    FILE *file = fopen(part, "r+b");
    if (file) {
        int failed = fwrite(content, 1, length, file) < length || fflush(file) != 0 || fsync(fileno(file)) != 0;
        explain(failed || rename(part, path) != 0, why);
        fclose(file);
    } else if (errno == ENOENT)
        snprintf(why, letters, "another run has started to write this file; only the last one keeps it");
    else
        explain(1, why);
}
