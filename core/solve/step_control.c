/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Lengths of steps from errors: a PI controller (Gustafsson 1991, ACM TOMS 17:533), which does not change them for
 * little, so that factors stay good. */
#include "solve/step_control.h"

#include <math.h>

#define AIM      0.5 /* part of what is allowed that the next step's error should have */
#define GROWTH   2.0 /* BDF2 is stable for steps that grow by less than 1 + sqrt(2)   */
#define SHRINK   0.3
#define BAND_LOW 0.8 /* a change between these is none */
#define BAND_TOP 1.25
/* After an error that was too large so many steps grow by no more than this. */
enum { CAREFUL = 3 };
#define CAREFUL_GROWTH 1.25

void control_extrapolate(double dt, double dt_previous, double dt_before, double *c)
{
    double a = dt, b = dt + dt_previous, d = dt + dt_previous + dt_before;

    c[0] = b * d / ((b - a) * (d - a));
    c[1] = a * d / ((a - b) * (d - b));
    c[2] = a * b / ((a - d) * (b - d));
}

double control_defect(double dt, double dt_previous)
{
    double w = dt / dt_previous;

    return dt * dt * (dt + dt_previous) * (1 + w) / (1 + 2 * w) / 6;
}

double control_milne(double dt, double dt_previous, double dt_before)
{
    double w = dt / dt_previous, c0 = (1 + 2 * w) / (1 + w) / dt;

    return 1 / (1 + c0 * (dt + dt_previous + dt_before));
}

void control_accept(step_control *c, double error, double dt, enum repeated repeated)
{
    const int cut = dt < 0.9 * c->next && repeated == NOT_REPEATED;
    double e = fmax(error, 1e-9), f = pow(AIM / e, 1.0 / 3), most = GROWTH;

    if (c->before > 0 && e > c->before) /* it grows: the next one's will, too */
        f *= pow(c->before / e, 0.4 / 3);
    if (repeated == REPEATED_ERROR)
        c->careful = CAREFUL;
    if (c->careful > 0) {
        most = CAREFUL_GROWTH;
        c->careful--;
    }
    f = fmin(fmax(f, SHRINK), repeated ? 1 : most);
    if (f > BAND_LOW && f < fmin(BAND_TOP, most))
        f = 1;
    /* a step that was cut to land somewhere says nothing against the length that was meant */
    c->next = error <= 1 && cut ? fmax(c->next, f * dt) : f * dt;
    c->before = cut ? 0 : e;
}

double control_shorten(double error, double dt)
{
    return dt * fmax(fmin(pow(AIM / error, 1.0 / 3), 0.7), SHRINK);
}

double control_land(double t, double dt, double until)
{
    double left = until - t, n = ceil(left / dt * (1 - 1e-10));

    return n <= 4 ? left / fmax(n, 1) : dt;
}
