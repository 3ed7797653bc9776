/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * plugflow picture DIR|FILE.vtu: the last fields of a run as a picture beside them. */
#include "cli/cli.h"

#include "io/picture.h"

#include <dirent.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The last fields_NNNNN.vtu of a folder. */
static int last_fields(const char *dir, char *path, size_t n, error *err)
{
    DIR *d = opendir(dir);
    struct dirent *e;
    char best[256] = "";

    if (!d)
        return error_set(
            err, ERR_IO,
            "%s: there is no such folder; give the folder of a run, as in plugflow picture out/cavity2d", dir);
    while ((e = readdir(d))) {
        size_t k = strlen(e->d_name);

        if (strncmp(e->d_name, "fields_", 7) == 0 && k > 4 && strcmp(e->d_name + k - 4, ".vtu") == 0 &&
            strcmp(e->d_name, best) > 0)
            snprintf(best, sizeof best, "%s", e->d_name);
    }
    closedir(d);
    if (!*best)
        return error_set(err, ERR_IO, "%s: holds no fields_*.vtu; has the run finished?", dir);
    snprintf(path, n, "%s/%s", dir, best);
    return 0;
}

/* The title of the case, from case.json (its second line). */
static void read_title(const char *dir, char *title, size_t n)
{
    char path[4400], line[1000];
    FILE *f;

    *title = 0;
    snprintf(path, sizeof path, "%s/case.json", dir);
    f = fopen(path, "r");
    while (f && fgets(line, sizeof line, f)) {
        char *s = strstr(line, "\"case\": \""), *end = strrchr(line, '"');

        if (s && end > s + 9) {
            snprintf(title, n, "%.*s", (int)(end - s - 9), s + 9);
            break;
        }
    }
    if (f)
        fclose(f);
}

/* Options of other commands that would have no effect here. */
static int refuse_options(const cli *o, error *err)
{
    const char *name = o->n_set              ? "--set"
                       : o->n_plugin         ? "--plugin"
                       : o->json             ? "--json"
                       : o->memory_limit > 0 ? "--memory"
                                             : NULL;

    if (!name)
        return 0;
    return error_set(
        err, ERR_USAGE,
        "picture draws what a run has left and takes no %s: possible are --field, --component, --range, "
        "--slice, --width, --arrows and --out; parameters go to plugflow run",
        name);
}

/* --slice AXIS or AXIS=POSITION. */
static int read_slice(const char *s, picture_options *p, error *err)
{
    char *end = NULL;

    p->slice_at = NAN;
    if (!s)
        return 0;
    p->slice_axis = s[0];
    if (s[0] && s[1] == '=')
        p->slice_at = strtod(s + 2, &end);
    if (!s[0] || !strchr("xyz", s[0]) || (s[1] && (!end || end == s + 2 || *end || !isfinite(p->slice_at))))
        return error_set(err, ERR_USAGE, "--slice %s: expected x, y or z, or a position as in z=0.5", s);
    return 0;
}

int cli_picture(const cli *o, error *err)
{
    char path[4096], out[4200], title[500], dir[4096];
    const char *operand = o->operand[0];
    size_t n = strlen(operand);
    picture_options p = {.field = o->field,
                         .component = o->component,
                         .width = o->width,
                         .low = o->low,
                         .high = o->high,
                         .lines = o->arrows};

    TRY(refuse_options(o, err));
    TRY(read_slice(o->slice, &p, err));
    if (n > 4 && strcmp(operand + n - 4, ".vtu") == 0) {
        snprintf(path, sizeof path, "%s", operand);
        snprintf(dir, sizeof dir, "%s", strrchr(operand, '/') ? operand : "./");
        *strrchr(dir, '/') = 0;
    } else {
        snprintf(dir, sizeof dir, "%s", operand);
        TRY(last_fields(operand, path, sizeof path, err));
    }
    read_title(dir, title, sizeof title);
    if (o->out)
        snprintf(out, sizeof out, "%s", o->out);
    else
        snprintf(out, sizeof out, "%s/%s.png", dir, o->field ? o->field : "picture");
    TRY(picture_draw(path, *title ? title : NULL, &p, out, err));
    printf("%s\n", out);
    return 0;
}
