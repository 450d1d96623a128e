/* SPDX-License-Identifier: BSD-3-Clause */
/* What C alone knows of models: the program's own place, how they are opened, and folders. */
#define _POSIX_C_SOURCE 200809L
#include <dirent.h>
#include <dlfcn.h>
#include <elf.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Path of the program; empty if the system does not know it. */
void model_program(char *path, size_t length)
{
    ssize_t found = readlink("/proc/self/exe", path, length - 1);
    path[found > 0 ? found : 0] = '\0';
}

/* 1 where all of a shared object is there: its last part is the table of its sections. The system's
   loader crashes on one that was cut off. */
static int is_whole(const char *path)
{
    Elf64_Ehdr head;
    FILE *file = fopen(path, "rb");
    if (!file)
        return 0;
    int whole = fread(&head, sizeof head, 1, file) == 1 && fseek(file, 0, SEEK_END) == 0 &&
                memcmp(head.e_ident, ELFMAG, SELFMAG) == 0 &&
                (Elf64_Off)ftell(file) >= head.e_shoff + head.e_shnum * head.e_shentsize;
    fclose(file);
    return whole;
}

/* A model that is opened; without one a null pointer, and why. */
void *model_open(const char *path, char *reason, size_t length)
{
    void *library = is_whole(path) ? dlopen(path, RTLD_NOW) : NULL;
    if (!library)
        snprintf(reason, length, "%s", is_whole(path) ? dlerror() : "it is no whole shared object");
    return library;
}

static int is_model(const struct dirent *entry)
{
    size_t length = strlen(entry->d_name);
    return length > 3 && strcmp(entry->d_name + length - 3, ".so") == 0;
}

/* Append the names of the models in a folder to `names`, in order, with a blank before each. */
void model_list(const char *folder, char *names, size_t length)
{
    struct dirent **found;
    int count = scandir(folder, &found, is_model, alphasort);
    for (int i = 0; i < count; i++) {
        size_t used = strlen(names);
        snprintf(names + used, length - used, " %.*s", (int)strlen(found[i]->d_name) - 3,
                 found[i]->d_name);
        free(found[i]);
    }
    if (count >= 0)
        free(found);
}
