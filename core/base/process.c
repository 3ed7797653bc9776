/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The state that signal handlers share with the program; process.h says who may write what. */
#include "base/process.h"

struct process_state process;
