/* SPDX-License-Identifier: BSD-3-Clause */
/* Ctrl-C during a call: the handler asks all runs to stop, and then does what was to be done before. */
#include <signal.h>
#include <stddef.h>

extern volatile int dde_stop_requested;
static struct sigaction before;
static int watching;

static void ask_to_stop(int number, siginfo_t *about, void *context) {
    dde_stop_requested = 1;
    if (before.sa_flags & SA_SIGINFO)
        before.sa_sigaction(number, about, context);
    else if (before.sa_handler != SIG_DFL && before.sa_handler != SIG_IGN)
        before.sa_handler(number);
}

/* Watch for Ctrl-C, unless this process ignores it, from now on (1), or no longer (0). Runs are asked
   to stop no longer. */
void dk_watch(int on) {
    dde_stop_requested = 0;
    if (on && !watching) {
        struct sigaction mine = {0};
        sigaction(SIGINT, NULL, &before);
        if (before.sa_handler == SIG_IGN) return;
        mine.sa_sigaction = ask_to_stop;
        mine.sa_flags = SA_SIGINFO | SA_ONSTACK;
        sigaction(SIGINT, &mine, NULL);
    } else if (!on && watching) {
        sigaction(SIGINT, &before, NULL);
    }
    watching = on;
}

/* Ask all runs of this process to stop (1), or let them run (0). */
void dk_stop(int on) { dde_stop_requested = on; }
