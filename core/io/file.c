/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "io/file.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static int failed(const char *path, const char *what, int code, error *err)
{
    const char *hint = code == ENOSPC || code == EFBIG || code == EDQUOT
                           ? "; the disk is full: free some space, or choose another folder with --out"
                       : code == EACCES || code == EROFS || code == EPERM ? "; choose another folder with --out"
                                                                          : "";

    return error_set(err, ERR_IO, "%s: cannot %s: %s%s", path, what, strerror(code), hint);
}

static int write_all(int fd, const char *s, size_t n)
{
    while (n > 0) {
        ssize_t k = write(fd, s, n);

        if (k < 0 && errno == EINTR)
            continue;
        if (k <= 0)
            return k < 0 ? errno : ENOSPC;
        s += k;
        n -= (size_t)k;
    }
    return 0;
}

int file_append(int fd, const char *path, const char *line, size_t n, error *err)
{
    off_t before = lseek(fd, 0, SEEK_END);
    int code = write_all(fd, line, n);

    if (code == 0)
        return 0;
    if (before >= 0 && ftruncate(fd, before) != 0) /* no half line stays */
        code = errno;
    return failed(path, "write", code, err);
}

int file_write(const char *path, const void *data, size_t n, error *err)
{
    char tmp[4200];
    int fd, code;

    snprintf(tmp, sizeof tmp, "%s.tmp", path);
    fd = open(tmp, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    if (fd < 0)
        return failed(path, "create", errno, err);
    code = write_all(fd, data, n);
    if (!code && fsync(fd) != 0 && errno != EINVAL && errno != EROFS)
        code = errno;
    if (close(fd) != 0 && !code)
        code = errno;
    if (!code && rename(tmp, path) != 0)
        code = errno;
    if (!code)
        return 0;
    unlink(tmp);
    return failed(path, "write", code, err);
}

/* Their number is asked first: a file that shrinks meanwhile is an error, one that grows is read up to there. */
static int read_open(const char *path, int fd, arena *a, unsigned char **bytes, size_t *size, error *err)
{
    struct stat s;

    if (fstat(fd, &s))
        return error_set(err, ERR_IO, "%s: %s", path, strerror(errno));
    if (!S_ISREG(s.st_mode))
        return error_set(err, ERR_IO, "%s: not a regular file", path);
    *size = (size_t)s.st_size;
    ARENA_NEW(a, *bytes, *size + 1, err);
    for (size_t n = 0; n < *size;) {
        ssize_t got = read(fd, *bytes + n, *size - n);

        if (got < 0 && errno == EINTR)
            continue;
        if (got <= 0)
            return error_set(err, ERR_IO, "%s: %s after %zu of %zu bytes", path,
                             got ? strerror(errno) : "file ends", n, *size);
        n += (size_t)got;
    }
    return 0;
}

int file_read(const char *path, arena *a, unsigned char **bytes, size_t *n, error *err)
{
    int fd = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK), status;

    if (fd < 0)
        return error_set(err, ERR_IO, "%s: %s", path, strerror(errno));
    status = read_open(path, fd, a, bytes, n, err);
    close(fd);
    return status;
}

int file_make_dir(const char *path, error *err)
{
    char part[4096];
    struct stat st;

    if (strlen(path) >= sizeof part)
        return error_set(err, ERR_IO, "%s: the name of the folder is too long", path);
    for (size_t i = 1; i <= strlen(path); i++) {
        if (path[i] && path[i] != '/')
            continue;
        snprintf(part, sizeof part, "%.*s", (int)i, path);
        if (mkdir(part, 0777) != 0 && errno != EEXIST && stat(part, &st) != 0)
            return failed(part, "create this folder", errno, err);
    }
    if (stat(path, &st) != 0 || !S_ISDIR(st.st_mode))
        return error_set(err, ERR_IO, "%s: is there and is no folder; choose another one with --out", path);
    if (access(path, W_OK) != 0)
        return failed(path, "write into this folder", errno, err);
    return 0;
}

static int ends_with(const char *s, const char *end)
{
    size_t n = strlen(s), k = strlen(end);

    return n >= k && strcmp(s + n - k, end) == 0;
}

int file_clean_run(const char *dir, error *err)
{
    static const char *const mine[] = {"forces.csv", "probes.csv",   "particles.csv", "particles.pvd", "fields.pvd",
                                       "run.jsonl",  "summary.json", "units.json",    "case.json"};
    DIR *d = opendir(dir);
    struct dirent *e;
    char lines[4600];

    while (d && (e = readdir(d))) {
        char path[4600];
        int remove_it = (strncmp(e->d_name, "fields_", 7) == 0 && ends_with(e->d_name, ".vtu")) ||
                        (strncmp(e->d_name, "particles_", 10) == 0 && ends_with(e->d_name, ".vtp"));

        for (size_t i = 0; i < sizeof mine / sizeof *mine; i++)
            remove_it |= strcmp(e->d_name, mine[i]) == 0;
        snprintf(path, sizeof path, "%s/%s", dir, e->d_name);
        if (remove_it && unlink(path) != 0) {
            closedir(d);
            return failed(path, "remove what an earlier run left", errno, err);
        }
    }
    if (d)
        closedir(d);
    snprintf(lines, sizeof lines, "%s/lines", dir);
    d = opendir(lines);
    while (d && (e = readdir(d))) {
        char path[5000];

        snprintf(path, sizeof path, "%s/%s", lines, e->d_name);
        if (ends_with(e->d_name, ".csv") && unlink(path) != 0) {
            closedir(d);
            return failed(path, "remove what an earlier run left", errno, err);
        }
    }
    if (d)
        closedir(d);
    return 0;
}

int table_create(table *t, const char *path, const char *const *column, int n, error *err)
{
    *t = (table){.fd = -1, .n_column = n};
    t->path = strdup(path);
    t->column = calloc((size_t)n, sizeof *t->column);
    if (!t->path || !t->column)
        return error_memory(err, path, 0);
    for (int i = 0; i < n; i++) {
        for (int k = 0; k < i; k++)
            if (strcmp(column[k], column[i]) == 0)
                return error_set(err, ERR_CASE,
                                 "%s would have two columns \"%s\": something that is shown is called like another "
                                 "column; give its line a name, as in term \"...\" { name = \"my\" }",
                                 path, column[i]);
        t->column[i] = strdup(column[i]);
        if (!t->column[i])
            return error_memory(err, path, 0);
    }
    return 0;
}

int table_open(table *t, error *err)
{
    text line = {0};
    int status;

    if (t->n_column == 0)
        return 0;
    for (int i = 0; i < t->n_column; i++)
        text_add(&line, "%s%s", i ? "," : "", t->column[i]);
    text_add(&line, "\n");
    status = line.failed ? error_memory(err, t->path, 0) : file_write(t->path, line.s, line.n, err);
    text_free(&line);
    if (status)
        return status;
    t->fd = open(t->path, O_WRONLY | O_APPEND);
    return t->fd < 0 ? failed(t->path, "open", errno, err) : 0;
}

int table_add(table *t, const double *row, error *err)
{
    text line = {0};
    int status;

    if (t->n_row == t->room) {
        long room = 2 * t->room + 64;
        double *p = realloc(t->row, (size_t)(room * t->n_column) * sizeof *p);

        if (!p)
            return error_memory(err, t->path, 8.0 * (double)(room * t->n_column));
        t->row = p;
        t->room = room;
    }
    memcpy(t->row + t->n_row++ * t->n_column, row, (size_t)t->n_column * sizeof *row);
    for (int i = 0; i < t->n_column; i++) {
        text_add(&line, "%s", i ? "," : "");
        if (isfinite(row[i])) /* else an empty cell */
            text_number(&line, row[i]);
    }
    text_add(&line, "\n");
    status = line.s ? file_append(t->fd, t->path, line.s, line.n, err) : error_memory(err, t->path, 0);
    text_free(&line);
    return status;
}

void table_destroy(table *t)
{
    for (int i = 0; t->column && i < t->n_column; i++)
        free(t->column[i]);
    free(t->column);
    free(t->path);
    free(t->row);
    if (t->fd > 0)
        close(t->fd);
    *t = (table){.fd = -1};
}
