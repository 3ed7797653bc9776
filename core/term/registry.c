/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Finding and loading plugins.  Each way in which loading can fail has its own message. */
#include "term/term.h"

#include "base/process.h"
#include "base/text.h"

#include <dirent.h>
#include <dlfcn.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#ifndef PF_PLUGIN_DIR
#define PF_PLUGIN_DIR "/usr/local/lib/plugflow/plugins"
#endif

static int add_dir(registry *r, const char *dir, error *err)
{
    if (r->n_dir == TERM_MAX_DIRS || !*dir)
        return 0;
    r->dir[r->n_dir] = arena_strdup(&r->memory, dir);
    return r->dir[r->n_dir++] ? 0 : error_memory(err, "plugin path", 0);
}

int registry_create(registry *r, const char *const *file, int n_file, error *err)
{
    const char *path = getenv("PLUGFLOW_PLUGIN_PATH");
    char exe[PATH_MAX];
    ssize_t n;

    memset(r, 0, sizeof *r);
    while (path && *path) {
        size_t k = strcspn(path, ":");

        snprintf(exe, sizeof exe, "%.*s", (int)k, path);
        TRY(add_dir(r, exe, err));
        path += k + (path[k] == ':');
    }
    n = readlink("/proc/self/exe", exe, sizeof exe - 16);
    if (n > 0) {
        exe[n] = 0;
        *strrchr(exe, '/') = 0;
        strcat(exe, "/plugins");
        TRY(add_dir(r, exe, err));
    }
    TRY(add_dir(r, PF_PLUGIN_DIR, err));
    for (int i = 0; i < n_file; i++) {
        term_file *f;

        TRY(registry_load(r, file[i], &f, err));
    }
    return 0;
}

static int load_equation(registry *r, term_file *f, void *symbol, error *err)
{
    char why[500] = "";
    pf_entry_fn *entry;
    const pf_plugin *d;

    memcpy(&entry, &symbol, sizeof entry);
    d = entry(&term_host, why, sizeof why);
    if (!d)
        return error_set(err, ERR_PLUGIN, "plugin %s declines to start: %s", f->path,
                         *why ? why : "it gives no reason");
    TRY(term_adopt(d, f->path, &r->memory, &f->plugin, err));
    for (int i = 0; i < r->n_file; i++)
        if (&r->file[i] != f && !r->file[i].refused && r->file[i].plugin.path &&
            strcmp(r->file[i].plugin.d.name, f->plugin.d.name) == 0)
            return error_set(err, ERR_PLUGIN, "two plugins are called \"%s\": %s and %s; remove or rename one",
                             d->name, r->file[i].path, f->path);
    f->kind = "equation";
    return 0;
}

static int load_other(term_file *f, void *solver, void *mesh, error *err)
{
    char why[500] = "";

    if (solver) {
        pf_solver_entry_fn *entry;

        memcpy(&entry, &solver, sizeof entry);
        f->solver = entry(why, sizeof why);
        if (f->solver && (f->solver->major != PF_SOLVER_MAJOR || f->solver->size < offsetof(pf_solver, flags)))
            return error_set(
                err, ERR_PLUGIN,
                "solver plugin %s has interface %u (%u bytes), this plugflow has %u (%zu bytes); rebuild it",
                f->path, f->solver->major, f->solver->size, PF_SOLVER_MAJOR, offsetof(pf_solver, flags));
        f->kind = "solver";
    } else {
        pf_mesh_entry_fn *entry;

        memcpy(&entry, &mesh, sizeof entry);
        f->mesh_reader = entry(why, sizeof why);
        if (f->mesh_reader &&
            (f->mesh_reader->major != PF_MESH_MAJOR || f->mesh_reader->size < sizeof(pf_mesh_reader)))
            return error_set(err, ERR_PLUGIN, "mesh plugin %s has interface %u, this plugflow has %u; rebuild it",
                             f->path, f->mesh_reader->major, PF_MESH_MAJOR);
        f->kind = "mesh";
    }
    if (!f->solver && !f->mesh_reader)
        return error_set(err, ERR_PLUGIN, "plugin %s declines to start: %s", f->path,
                         *why ? why : "it gives no reason");
    return 0;
}

static int load_file(registry *r, term_file *f, error *err)
{
    void *handle, *equation, *solver, *mesh;

    if (access(f->path, F_OK) != 0)
        return error_set(err, ERR_PLUGIN, "plugin file %s does not exist", f->path);
    handle = dlopen(f->path, RTLD_NOW | RTLD_LOCAL);
    if (!handle)
        return error_set(err, ERR_PLUGIN, "plugin %s cannot be loaded: %s", f->path, dlerror());
    equation = dlsym(handle, "pf_plugin_entry");
    solver = dlsym(handle, "pf_solver_entry");
    mesh = dlsym(handle, "pf_mesh_entry");
    if (equation)
        return load_equation(r, f, equation, err);
    if (solver || mesh)
        return load_other(f, solver, mesh, err);
    return error_set(
        err, ERR_PLUGIN,
        "%s is no plugin: it exports none of pf_plugin_entry, pf_solver_entry, pf_mesh_entry; is the entry "
        "function marked PF_EXPORT?",
        f->path);
}

int registry_load(registry *r, const char *path, term_file **out, error *err)
{
    char real[PATH_MAX];
    term_file *f;
    int status;

    if (!realpath(path, real))
        snprintf(real, sizeof real, "%s", path);
    for (int i = 0; i < r->n_file; i++)
        if (strcmp(r->file[i].path, real) == 0) {
            *out = &r->file[i];
            return r->file[i].refused ? error_set(err, ERR_PLUGIN, "%s", r->file[i].refused) : 0;
        }
    if (r->n_file == TERM_MAX_FILES)
        return error_set(err, ERR_PLUGIN, "more than %d plugin files", TERM_MAX_FILES);
    f = *out = &r->file[r->n_file++];
    f->path = arena_strdup(&r->memory, real);
    if (!f->path)
        return error_memory(err, "plugin", 0);
    process_enter(f->path, "entry", "while it is loaded", -1);
    status = load_file(r, f, err);
    process_leave();
    if (status)
        f->refused = arena_strdup(&r->memory, err->text);
    return status;
}

static int is_file(const char *path)
{
    struct stat st;

    return stat(path, &st) == 0 && S_ISREG(st.st_mode);
}

/* Calls visit for every D/NAME.so and D/NAME/NAME.so; stops when it returns non-zero. */
static int each_file(const registry *r, int (*visit)(const char *path, const char *name, void *), void *arg)
{
    for (int d = 0; d < r->n_dir; d++) {
        struct dirent **list;
        int n = scandir(r->dir[d], &list, NULL, alphasort), stop = 0;

        for (int i = 0; i < n; i++) {
            char path[PATH_MAX], name[256];
            const char *entry = list[i]->d_name;
            size_t k = strlen(entry);

            if (k > 3 && strcmp(entry + k - 3, ".so") == 0) {
                snprintf(name, sizeof name, "%.*s", (int)(k - 3), entry);
                snprintf(path, sizeof path, "%s/%s", r->dir[d], entry);
            } else {
                snprintf(name, sizeof name, "%s", entry);
                snprintf(path, sizeof path, "%s/%s/%s.so", r->dir[d], entry, entry);
            }
            if (!stop && *entry != '.' && is_file(path))
                stop = visit(path, name, arg);
            free(list[i]);
        }
        if (n >= 0)
            free(list);
        if (stop)
            return stop;
    }
    return 0;
}

struct wanted {
    const char *name;
    char path[PATH_MAX];
    int n_seen;
    char seen[TERM_MAX_FILES][64];
};

static int visit_wanted(const char *path, const char *name, void *arg)
{
    struct wanted *w = arg;

    if (w->n_seen < TERM_MAX_FILES)
        snprintf(w->seen[w->n_seen++], sizeof w->seen[0], "%.63s", name);
    if (strcmp(name, w->name) != 0)
        return 0;
    snprintf(w->path, sizeof w->path, "%s", path);
    return 1;
}

static int not_found(const registry *r, const struct wanted *w, error *err)
{
    const char *name[TERM_MAX_FILES];
    text t = {0};
    int status;

    for (int i = 0; i < w->n_seen; i++)
        name[i] = w->seen[i];
    text_add(&t, "there is no plugin \"%s\"%s", w->name,
             text_hint(text_nearest(w->name, name, (size_t)w->n_seen)).s);
    text_add(&t, "\n    looked for:");
    for (int d = 0; d < r->n_dir; d++)
        text_add(&t, "\n      %s/%s.so\n      %s/%s/%s.so", r->dir[d], w->name, r->dir[d], w->name, w->name);
    text_add(&t, "\n    (--plugin FILE loads a file, PLUGFLOW_PLUGIN_PATH adds folders, plugflow plugins lists "
                 "what is found)");
    status = error_set(err, ERR_PLUGIN, "%s", t.s ? t.s : "plugin not found");
    text_free(&t);
    return status;
}

/* Whether a loaded file is what a case calls `name`: solvers and readers of meshes go by the name of their file. */
static int goes_by(const term_file *f, const char *name)
{
    const char *file = strrchr(f->path, '/') ? strrchr(f->path, '/') + 1 : f->path;
    const size_t n = strlen(name);

    if (f->plugin.path)
        return strcmp(f->plugin.d.name, name) == 0;
    if (f->solver && strncmp(name, "solver_", 7) == 0 && strcmp(f->solver->name, name + 7) == 0)
        return 1;
    return strncmp(file, name, n) == 0 && strcmp(file + n, ".so") == 0;
}

static int find(registry *r, const char *name, const char *kind, term_file **out, error *err)
{
    struct wanted *w = calloc(1, sizeof *w);
    int status;

    if (!w)
        return error_memory(err, "plugin search", sizeof *w);
    w->name = name;
    each_file(r, visit_wanted, w);
    *out = NULL;
    for (int i = 0; i < r->n_file && !*out; i++)
        if (!r->file[i].refused && strcmp(r->file[i].kind, kind) == 0 && goes_by(&r->file[i], name))
            *out = &r->file[i];
    if (*out && *w->path) {
        char real[PATH_MAX];

        if (realpath(w->path, real) && strcmp(real, (*out)->path) != 0) {
            status = error_set(err, ERR_PLUGIN, "two plugins are called \"%s\": %s and %s; remove or rename one",
                               name, (*out)->path, real);
            free(w);
            return status;
        }
    }
    if (*out)
        status = 0;
    else if (*w->path)
        status = registry_load(r, w->path, out, err);
    else
        status = not_found(r, w, err);
    free(w);
    if (!status && strcmp((*out)->kind, kind) != 0)
        status = error_set(err, ERR_PLUGIN, "plugin \"%s\" (%s) is of kind %s, here one of kind %s is needed", name,
                           (*out)->path, (*out)->kind, kind);
    return status;
}

int registry_equation(registry *r, const char *name, const term_plugin **out, error *err)
{
    term_file *f;

    TRY(find(r, name, "equation", &f, err));
    if (strcmp(f->plugin.d.name, name) != 0)
        return error_set(err, ERR_PLUGIN,
                         "%s describes a plugin called \"%s\"; file and plugin must have the same name", f->path,
                         f->plugin.d.name);
    *out = &f->plugin;
    return 0;
}

int registry_knows(registry *r, const char *name, const char **near)
{
    struct wanted *w = calloc(1, sizeof *w);
    const char *seen[2 * TERM_MAX_FILES];
    const char *best;
    size_t n = 0;
    int known = 0;

    *near = NULL;
    if (!w)
        return 1; /* loading it will say that there is no memory */
    w->name = name;
    each_file(r, visit_wanted, w);
    for (int i = 0; i < r->n_file; i++)
        if (!r->file[i].refused) {
            known |= goes_by(&r->file[i], name);
            if (r->file[i].plugin.path)
                seen[n++] = r->file[i].plugin.d.name;
        }
    known |= *w->path != 0;
    for (int i = 0; i < w->n_seen; i++)
        seen[n++] = w->seen[i];
    best = known ? NULL : text_nearest(name, seen, n);
    *near = best ? arena_strdup(&r->memory, best) : NULL;
    free(w);
    return known;
}

int registry_solver(registry *r, const char *name, const pf_solver **out, error *err)
{
    term_file *f;

    TRY(find(r, name, "solver", &f, err));
    *out = f->solver;
    return 0;
}

int registry_mesh_reader(registry *r, const char *name, const pf_mesh_reader **out, error *err)
{
    term_file *f;

    TRY(find(r, name, "mesh", &f, err));
    *out = f->mesh_reader;
    return 0;
}

static int visit_load(const char *path, const char *name, void *arg)
{
    registry *r = arg;
    term_file *f;
    error ignored;

    (void)name;
    registry_load(r, path, &f, &ignored); /* the reason stays in f->refused */
    return r->n_file == TERM_MAX_FILES;
}

int registry_scan(registry *r, error *err)
{
    (void)err;
    each_file(r, visit_load, r);
    return 0;
}

void registry_destroy(registry *r)
{
    arena_free(&r->memory); /* shared objects stay loaded: their code may still be referred to */
    memset(r, 0, sizeof *r);
}
