/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * error.h -- the one way to fail: functions return 0 or an error_code and write a message
 * with its subject and its numbers into *err.  The codes are the program's exit codes. */
#ifndef BASE_ERROR_H
#define BASE_ERROR_H

enum error_code {
    ERR_USAGE = 2,
    ERR_CASE = 3,
    ERR_MESH = 4,
    ERR_PLUGIN = 5,
    ERR_CONVERGE = 6,
    ERR_IO = 7,
    ERR_MEMORY = 8,
    ERR_SIGNAL = 128 /* + the number of the signal that stopped the program */
};

typedef struct error {
    int code;
    int retry; /* a smaller step or increment may help */
    char text[6000];
} error;

/* Sets the error and returns code, so: return error_set(err, ERR_MESH, "...", ...); */
int error_set(error *err, int code, const char *fmt, ...) __attribute__((format(printf, 3, 4)));
/* Puts a prefix before the text that is there. */
int error_prefix(error *err, const char *fmt, ...) __attribute__((format(printf, 2, 3)));
int error_memory(error *err, const char *what, double bytes);

#define TRY(call)                                                                                                  \
    do {                                                                                                           \
        int try_status_ = (call);                                                                                  \
        if (try_status_)                                                                                           \
            return try_status_;                                                                                    \
    } while (0)

#endif
