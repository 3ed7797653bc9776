/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * case.json: the case as it was understood, with plugin versions, for the archive. */
#include "run/run.h"

#include <stdio.h>

/* What bodies say for terms: "bodies": {"charge": [3, -1], "moment": [[1, 0], [0, 1]]}. */
static void add_body_keys(const description *d, text *t)
{
    for (int i = 0; i < d->n_key; i++) {
        const body_key *k = &d->key[i];

        text_add(t, "%s\"%s\": [", i ? ", " : ",\n  \"bodies\": {", k->name);
        for (int j = 0; j < d->n_body * k->n_comp; j++) {
            int c = j % k->n_comp;

            text_add(t, "%s%s", j ? ", " : "", k->vector && c == 0 ? "[" : "");
            text_number(t, k->value[j]);
            text_add(t, "%s", k->vector && c == k->n_comp - 1 ? "]" : "");
        }
        text_add(t, "]");
    }
    text_add(t, "%s", d->n_key ? "}" : "");
}

int output_case(const run *r, error *err)
{
    const problem *p = r->p;
    char path[4600];
    text t = {0};
    int status;

    text_add(&t, "{\n  \"case\": ");
    text_json(&t, p->description.c->title ? p->description.c->title : "");
    text_add(&t, ",\n  \"file\": ");
    text_json(&t, p->description.c->path);
    text_add(&t,
             ",\n  \"plugflow\": \"%s\",\n  \"dimension\": %d,\n  \"cells\": %lld,\n  \"cell\": \"%s\",\n  "
             "\"parameters\": {",
             PF_VERSION, p->description.dim, (long long)p->mesh.n_cell, p->mesh.type->name);
    for (int i = 0; i < p->description.c->n_param; i++) {
        text_add(&t, "%s", i ? ", " : "");
        text_json(&t, p->description.c->param[i].name);
        text_add(&t, ": ");
        text_json(&t, p->description.c->param[i].value);
    }
    text_add(&t, "},\n  \"terms\": [");
    for (int i = 0; i < p->description.n_use; i++) {
        const term_use *u = &p->description.use[i];

        text_add(&t, "%s\n    {\"term\": \"%s.%s\", \"version\": \"%s\", \"parameters\": {", i ? "," : "",
                 u->plugin->d.name, u->term->name, u->plugin->d.version);
        for (uint32_t k = 0; k < u->term->n_param; k++) {
            const pf_param *q = &u->term->param[k];
            const char *at = (const char *)u->params + q->offset;

            text_add(&t, "%s\"%s\": ", k ? ", " : "", q->name);
            if (q->type == PF_T_REAL) {
                text_number(&t, *(const double *)(const void *)at);
            } else if (q->type == PF_T_VECTOR) {
                for (int d = 0; d < p->description.dim; d++) {
                    text_add(&t, d ? ", " : "[");
                    text_number(&t, ((const double *)(const void *)at)[d]);
                }
                text_add(&t, "]");
            } else {
                text_add(&t, "%d", *(const int *)(const void *)at);
            }
        }
        text_add(&t, "}}");
    }
    text_add(&t, "\n  ]");
    add_body_keys(&p->description, &t);
    text_add(&t, ",\n  \"source\": ");
    text_json(&t, p->description.c->n_source ? p->description.c->source[0].text : "");
    text_add(&t, "\n}\n");
    snprintf(path, sizeof path, "%s/case.json", r->dir);
    status = t.failed ? error_memory(err, path, 0) : file_write(path, t.s, t.n, err);
    text_free(&t);
    return status;
}
