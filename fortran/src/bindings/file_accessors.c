/* What C alone knows of files: error numbers, and the layout of struct stat and struct dirent. */
#define _POSIX_C_SOURCE 200809L
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Answers beside 0 (done) and error numbers; `file_system` has the same. */
enum { missing = -1, occupied = -2 };

static int reason(void)
{
    return errno == ENOENT ? missing : errno;
}

/* The folder of a path, with a slash at its end. */
static const char *folder_of(const char *path)
{
    static char folder[4096];
    const char *slash = strrchr(path, '/');
    snprintf(folder, sizeof folder, "%.*s", slash ? (int)(slash - path) + 1 : 2, slash ? path : "./");
    return folder;
}

/* Whether a file can be made at a path, or replaced there. */
int file_place(const char *path)
{
    struct stat found;
    if (lstat(path, &found) == 0 && !S_ISREG(found.st_mode))
        return occupied;
    return access(folder_of(path), W_OK | X_OK) == 0 ? 0 : reason();
}

/* 1 where both paths lead to one file. */
int file_is_same(const char *one, const char *other)
{
    struct stat a, b;
    return stat(one, &a) == 0 && stat(other, &b) == 0 && a.st_dev == b.st_dev &&
           a.st_ino == b.st_ino;
}

/* 1 where something is at `path` that is no regular file. */
int file_is_special(const char *path)
{
    struct stat found;
    return stat(path, &found) == 0 && !S_ISREG(found.st_mode);
}

/* Whether `length` more bytes have room at the end of a file that is there. */
int file_room(const char *path, size_t length)
{
    int file = open(path, O_WRONLY);
    if (file < 0)
        return reason();
    int why = posix_fallocate(file, lseek(file, 0, SEEK_END), (off_t)length);
    close(file);
    return why;
}

/* Write all of a file: one that is there, or one where nothing is yet. */
int file_write(const char *path, const char *content, size_t length, int there)
{
    FILE *file = fopen(path, there ? "r+b" : "wbx");
    if (!file)
        return reason();
    if (fwrite(content, 1, length, file) == length)
        return fclose(file) == 0 ? 0 : reason();
    int why = reason();
    fclose(file);
    return why;
}

/* Send what is at `path` to the disk, so that it outlasts a loss of power. */
static int sync_to_disk(const char *path)
{
    int file = open(path, O_RDONLY);
    if (file < 0)
        return reason();
    int why = fsync(file) == 0 ? 0 : reason();
    close(file);
    return why;
}

/* Rename a file in its folder once it is on the disk; not all file systems can send a folder there. */
int file_rename(const char *from, const char *to)
{
    int why = sync_to_disk(from);
    if (why == 0 && rename(from, to) != 0)
        why = reason();
    if (why == 0)
        sync_to_disk(folder_of(to));
    return why;
}

/* Remove the files whose path is `path`, a point, digits and hyphens, and `ending`. */
void file_remove_marked(const char *path, const char *ending)
{
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
    DIR *listed = opendir(folder_of(path));
    if (!listed)
        return;
    size_t length = strlen(name);
    for (struct dirent *entry = readdir(listed); entry; entry = readdir(listed)) {
        const char *mark = entry->d_name + length + 1;
        if (strncmp(entry->d_name, name, length) != 0 || entry->d_name[length] != '.')
            continue;
        size_t digits = strspn(mark, "0123456789-");
        if (digits > 0 && strcmp(mark + digits, ending) == 0)
            unlinkat(dirfd(listed), entry->d_name, 0);
    }
    closedir(listed);
}

/* What the system says of an error number. */
void file_reason(int number, char *words, size_t length)
{
    snprintf(words, length, "%s", strerror(number));
}
