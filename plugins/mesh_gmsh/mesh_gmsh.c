/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Meshes of Gmsh: .msh files of every version, and .geo files, which are meshed on the spot.
 *
 * libgmsh can crash, exhaust memory or loop on a damaged file, and keeps global state, so it
 * runs in a child process: the child reads and renumbers, the parent gets the finished arrays
 * through a pipe.  Whatever ends the child, the parent returns an error.
 *
 * Cells are those of the highest dimension (in physical groups of that dimension, if there
 * are any); boundaries are the physical groups one dimension below. */
#include "gmsh_model.h"

#include <plugflow/mesh.h>
#include <plugflow/plugin.h>

#include <gmshc.h>

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

/* Limits of the child on a .msh file: a damaged one must not take the machine with it. */
#define MEMORY_BASE     ((rlim_t)2 << 30)
#define MEMORY_PER_BYTE ((rlim_t)2000)
#define SECONDS_BASE    ((rlim_t)60)
#define BYTES_PER_SEC   ((rlim_t)100000)

/* What the parent keeps for release(). */
typedef struct owned {
    double *x, reference[MAX_NODES * 3];
    int64_t *cell, *facet;
    int32_t *facet_name;
    char *text;
    const char **name;
} owned;

/* The child. */

static int send_all(int fd, const void *data, int64_t n)
{
    const char *p = data;

    while (n > 0) {
        ssize_t k = write(fd, p, (size_t)n);

        if (k < 0 && errno == EINTR)
            continue;
        if (k <= 0)
            return -1;
        p += k;
        n -= k;
    }
    return 0;
}

static void limit(int resource, rlim_t value)
{
    struct rlimit r;

    if (getrlimit(resource, &r) == 0 && (r.rlim_cur == RLIM_INFINITY || value < r.rlim_cur)) {
        r.rlim_cur = value;
        setrlimit(resource, &r);
    }
}

/* Pages of data this process has now (statm: size resident shared text lib data dirty). */
static rlim_t data_now(void)
{
    unsigned long pages = 0;
    FILE *f = fopen("/proc/self/statm", "r");

    if (f && fscanf(f, "%*u %*u %*u %*u %*u %lu", &pages) != 1)
        pages = 0;
    if (f)
        fclose(f);
    return (rlim_t)pages * (rlim_t)sysconf(_SC_PAGESIZE);
}

/* Silent, killable, without core dumps; bounded on .msh files, whose size says what they need. */
static void become_child(const char *path, off_t bytes)
{
    static const int caught[] = {SIGINT, SIGTERM, SIGHUP, SIGSEGV, SIGBUS, SIGFPE, SIGABRT, SIGXCPU, SIGALRM};
    int null = open("/dev/null", O_RDWR | O_CLOEXEC);
    sigset_t none;

    for (size_t i = 0; i < sizeof caught / sizeof *caught; i++)
        signal(caught[i], SIG_DFL);
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, NULL);
    for (int fd = 0; fd < 3 && null >= 0; fd++)
        dup2(null, fd);
    limit(RLIMIT_CORE, 0);
    if (!model_has_suffix(path, ".geo")) {
        limit(RLIMIT_CPU, SECONDS_BASE + (rlim_t)bytes / BYTES_PER_SEC);
        limit(RLIMIT_DATA, data_now() + MEMORY_BASE + MEMORY_PER_BYTE * (rlim_t)bytes);
    }
}

static int build_mesh(build *b, int dim)
{
    if (model_open(b, dim) || model_read_nodes(b) || model_read_cells(b) || model_read_boundaries(b))
        return b->w->status;
    return 0;
}

_Noreturn static void child(const char *path, int dim, off_t bytes, int fd)
{
    wire w = {.status = PF_MESH_OK};
    build b = {.path = path, .w = &w};
    int bad;

    become_child(path, bytes);
    bad = build_mesh(&b, dim);
    if (send_all(fd, &w, sizeof w) || bad || send_all(fd, b.x, w.n_node * w.dim * 8) ||
        send_all(fd, b.cell, w.n_cell * w.n_local * 8) || send_all(fd, b.facet, w.n_facet * w.facet_vertices * 8) ||
        send_all(fd, b.facet_name, w.n_facet * 4) || send_all(fd, b.names, w.n_text))
        _exit(1);
    _exit(0);
}

/* The parent. */

static int refuse(char *err, size_t nerr, int status, const char *path, const char *what, const char *detail)
{
    snprintf(err, nerr, "%s: %s%s", path, what, detail);
    return status;
}

/* All n bytes, or -1. */
static int receive(int fd, void *data, int64_t n)
{
    char *p = data;

    while (n > 0) {
        ssize_t k = read(fd, p, (size_t)n);

        if (k < 0 && errno == EINTR)
            continue;
        if (k <= 0)
            return -1;
        p += k;
        n -= k;
    }
    return 0;
}

static void release(pf_mesh_data *m)
{
    owned *o = m->owner;

    if (o) {
        free(o->x);
        free(o->cell);
        free(o->facet);
        free(o->facet_name);
        free(o->text);
        free(o->name);
        free(o);
    }
    memset(m, 0, sizeof *m);
}

/* The arrays after the header; PF_MESH_BAD when the child ended early. */
static int receive_mesh(int fd, const wire *w, owned *o)
{
    o->x = model_array(w->n_node * w->dim, sizeof *o->x);
    o->cell = model_array(w->n_cell * w->n_local, sizeof *o->cell);
    o->facet = model_array(w->n_facet * w->facet_vertices, sizeof *o->facet);
    o->facet_name = model_array(w->n_facet, sizeof *o->facet_name);
    o->text = model_array(w->n_text, 1);
    o->name = model_array(w->n_name, sizeof *o->name);
    if (!o->x || !o->cell || !o->facet || !o->facet_name || !o->text || !o->name)
        return PF_MESH_MEMORY;
    if (receive(fd, o->x, w->n_node * w->dim * 8) || receive(fd, o->cell, w->n_cell * w->n_local * 8) ||
        receive(fd, o->facet, w->n_facet * w->facet_vertices * 8) || receive(fd, o->facet_name, w->n_facet * 4) ||
        receive(fd, o->text, w->n_text))
        return PF_MESH_BAD;
    for (int64_t i = 0, at = 0; i < w->n_name; i++, at += (int64_t)strlen(o->text + at) + 1)
        o->name[i] = o->text + at;
    memcpy(o->reference, w->reference, sizeof o->reference);
    return 0;
}

static void hand_out(const wire *w, owned *o, pf_mesh_data *out)
{
    *out = (pf_mesh_data){
        .size = sizeof *out,
        .dim = w->dim,
        .type = w->type,
        .n_node = w->n_node,
        .n_cell = w->n_cell,
        .n_facet = w->n_facet,
        .x = o->x,
        .cell = o->cell,
        .reference = o->reference,
        .facet = o->facet,
        .facet_vertices = w->facet_vertices,
        .facet_name = o->facet_name,
        .n_name = (int32_t)w->n_name,
        .name = o->name,
        .owner = o,
    };
}

/* Ends the child; the signal that had ended it before, or 0. */
static int reap(pid_t pid, int kill_it)
{
    int status = 0;
    pid_t done;

    if (kill_it)
        kill(pid, SIGKILL);
    do
        done = waitpid(pid, &status, 0);
    while (done < 0 && errno == EINTR);
    return done == pid && WIFSIGNALED(status) ? WTERMSIG(status) : 0;
}

static int died(char *err, size_t nerr, const char *path, int sig)
{
    const char *what = "Gmsh broke down on it: the file is damaged; write or copy it again";

    if (sig == SIGINT || sig == SIGTERM)
        what = "reading was interrupted";
    else if (sig == SIGXCPU)
        what = "Gmsh did not come to an end with it: the file is damaged; write or copy it again";
    else if (model_has_suffix(path, ".geo"))
        what = "Gmsh ended while it made this mesh; look at the script with: gmsh FILE";
    return refuse(err, nerr, PF_MESH_BAD, path, what, "");
}

static int check_path(const char *path, off_t *bytes, char *err, size_t nerr)
{
    struct stat st;

    if (stat(path, &st) != 0)
        return refuse(err, nerr, PF_MESH_NO_FILE, path, "cannot be opened: ", strerror(errno));
    if (!S_ISREG(st.st_mode))
        return refuse(err, nerr, PF_MESH_NO_FILE, path, S_ISDIR(st.st_mode) ? "is a directory" : "is not a file",
                      ", a .msh or .geo file is needed");
    if (access(path, R_OK) != 0)
        return refuse(err, nerr, PF_MESH_NO_FILE, path, "cannot be read: ", strerror(errno));
    *bytes = st.st_size;
    return 0;
}

static int read_mesh(const char *path, int dim, pf_mesh_data *out, char *err, size_t nerr)
{
    owned *o = calloc(1, sizeof *o);
    off_t bytes = 0;
    int fd[2], status, sig;
    pid_t pid;
    wire w;

    memset(out, 0, sizeof *out);
    status = check_path(path, &bytes, err, nerr);
    if (status || !o || pipe2(fd, O_CLOEXEC) != 0) {
        free(o);
        return status ? status : refuse(err, nerr, PF_MESH_MEMORY, path, "no memory or pipe: ", strerror(errno));
    }
    pid = fork();
    if (pid == 0)
        child(path, dim, bytes, fd[1]);
    close(fd[1]);
    status = pid < 0 ? PF_MESH_MEMORY : receive(fd[0], &w, sizeof w) ? PF_MESH_BAD : 0;
    out->owner = o;
    if (!status)
        status = w.status ? w.status : receive_mesh(fd[0], &w, o);
    else
        w.status = 0;
    close(fd[0]);
    sig = pid > 0 ? reap(pid, status == PF_MESH_MEMORY) : 0;
    if (!status) {
        hand_out(&w, o, out);
        return PF_MESH_OK;
    }
    release(out);
    if (w.status) {
        snprintf(err, nerr, "%s", w.text);
        return w.status;
    }
    return status == PF_MESH_MEMORY ? refuse(err, nerr, status, path, "no memory for the mesh or its reader", "")
                                    : died(err, nerr, path, sig);
}

static const char *const suffixes[] = {".msh", ".geo", NULL};

static const pf_mesh_reader reader = {
    .size = sizeof(pf_mesh_reader),
    .major = PF_MESH_MAJOR,
    .sizes = PF_SIZES,
    .name = "mesh_gmsh",
    .version = "1.0 (Gmsh " GMSH_API_VERSION ")",
    .suffix = suffixes,
    .read = read_mesh,
    .release = release,
};

__attribute__((visibility("default"))) const pf_mesh_reader *pf_mesh_entry(char *err, size_t nerr);

const pf_mesh_reader *pf_mesh_entry(char *err, size_t nerr)
{
    (void)err, (void)nerr;
    return &reader;
}
