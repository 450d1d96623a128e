/* SPDX-License-Identifier: BSD-3-Clause */
/* delaykit: runs of compiled models with constant delays, and methods for them.
 *
 * A model is an object that the generator made (python -m generator DEFINITION.yaml NAME.so), opened
 * by its path. Each procedure that can fail returns 0, or 1 with a message, and gives results even
 * then: what was reached. Results are read by names, their arrays live until dk_free. All procedures
 * may be called from several threads at once; a model is not changed by them. Reals are double,
 * integers int32_t. Nothing prints, nothing stops the program.
 */
#ifndef DELAYKIT_H
#define DELAYKIT_H
#include <stdint.h>

typedef struct dk_model dk_model;
typedef struct dk_results dk_results;

/* A past in polynomials, as `dense_...` of the results of a run with keep_all give it. Times are
 * pairs of numbers whose sum they are. */
typedef struct {
    const double *origin;        /* (2): before it `past` of the request holds */
    const double *kink;          /* (kinks, 2): where a derivative jumps */
    const double *step_start;    /* (steps, 2) */
    const double *step_length;   /* (steps) */
    const double *valid_for;     /* (steps): time for which the polynomial is valid */
    const double *nodes;         /* (steps, degree): Newton nodes in units of the length */
    const double *coefficients;  /* (steps, components, 1 + degree) */
    const int32_t *passages;     /* (kinks): delays passed since the cause; -1: a jump of the state */
    const int32_t *generation;   /* (kinks): delays passed, 0 at the cause */
    const int32_t *kept;         /* (components): numbers of states from 1, all delayed ones; of a ring all */
    int32_t kinks, steps, degree, components;
} dk_history;

/* What is wanted of a run. n is the number of states, times that of blocks; states are in the order
 * of the blocks. */
typedef struct {
    const double *parameters;       /* in the order of the definition */
    const double *past;             /* (n): constant states before the start, or before `origin` */
    const double *state;            /* (n) at the start, with `history`; NULL: as the past */
    double t_start, t_start_rest;   /* the start, and what rounding took from it */
    double t_end;
    const char *method;             /* one that dk_methods lists */
    const double *rtol, *atol;      /* (n) tolerances of a step; NULL: a share of values */
    double first_step, max_step;    /* 0: chosen */
    int64_t max_steps;
    double max_bytes;               /* most memory of the past */
    const double *times;            /* (time_count) of samples, ascending */
    const double *breaks;           /* (break_count): where the equations or the past jump */
    const double *doses;            /* (dose_count, 1 + n): a time, and what is added to the state */
    const double *event_level;      /* (event_count) each */
    const int32_t *event_component; /* from 1 */
    const int32_t *event_direction; /* -1 falling, 1 rising, 0 both */
    const int32_t *event_terminal, *event_of_slope;
    double share;                   /* longest time between samples that follow the steps, of a step */
    int32_t blocks, ends;           /* of a chain; 1 free, 2 ring, 3 plate */
    int32_t time_count;             /* -1: samples follow the steps */
    int32_t break_count, dose_count, event_count;
    int32_t keep_all;               /* 1: dense output of the whole run */
    const dk_history *history;
} dk_request;

/* The message has room for `length` letters with its null character. */
/* network: the path of the file with the nodes and edges of a network, otherwise not read. */
int32_t dk_open(const char *path, const char *network, dk_model **model, char *message,
                int32_t length);
void dk_close(dk_model *model);
/* Their number; with room for them, and not NULL, the delays. */
void dk_delays(const dk_model *model, const double *parameters, double *lag, int32_t *number);
/* The longest delay or, without one, the inverse of the fastest rate at the start. */
double dk_unit_of_time(const dk_model *model, const dk_request *request);
int32_t dk_integrate(const dk_model *model, const dk_request *request, dk_results **results,
                     char *message, int32_t length);
/* The equations at `past` (`rate`), and their derivatives that are not 0: `row`, `column`, `lag` (0:
 * by the state itself) and `value` of each. */
int32_t dk_linearise(const dk_model *model, const dk_request *request, dk_results **results,
                     char *message, int32_t length);

/* A command of the program with the text of a namelist (`spring_block COMMAND --help` lists its keys),
 * on a model. */
int32_t dk_command(const dk_model *model, const char *command, const char *namelist,
                   dk_results **results, char *message, int32_t length);

/* Values of a variable, first dimension the slowest, and their number; NULL if there is none. */
const void *dk_values(const dk_results *results, const char *name, int32_t *length);
/* Dimensions, variables and attributes, a line each with tabs between words: `dimension NAME
 * LENGTH`, `variable NAME KIND DIMENSION ...`, `attribute VARIABLE NAME KIND VALUE ...`. Returns the
 * number of letters, and writes them if there is room. */
int32_t dk_describe(const dk_results *results, char *text, int32_t length);
void dk_free(dk_results *results);
/* Methods, a line each: name, tab, what it reads of a model beside the equations (jacobian, series)
 * or f. Returns and writes as dk_describe. */
int32_t dk_methods(char *text, int32_t length);

/* From now on SIGINT asks all runs to stop (1), or no longer (0); none is asked to before. */
void dk_watch(int32_t on);
/* Ask all runs of the process to stop before their next step (1), or let them run (0). */
void dk_stop(int32_t on);
#endif
