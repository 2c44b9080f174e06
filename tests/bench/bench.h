/* What every part of the benchmark needs: a stopwatch and a table. A part times two ways to do one
   thing in one run, side by side, and enters a row; ratios count, milliseconds belong to the
   machine. */
#ifndef TESTS_BENCH_H
#define TESTS_BENCH_H

#include "base/arena.h"

/* Seconds that one run took: the least of all repeats, and their median. */
typedef struct { double least, median; } Timing;

/* Runs once to warm up, then at least ten times; what is short is done many times in each. */
Timing bench_time(void (*run)(void *context), void *context);

/* A thing that was done and what it was measured against. */
typedef struct {
    const char *scene, *what;
    long long count;        /* how much of it, exactly: pairs, points, vertices, bytes */
    const char *unit;       /* of count */
    Timing time;
    const char *against;    /* NULL: nothing, and no ratio */
    Timing base;            /* of that */
    double asked;           /* the ratio that we want to reach; 0: none */
} BenchRow;

typedef struct Bench Bench;
void bench_enter(Bench *b, BenchRow row);

/* A number that is no time: the exponent of a growth, a share. */
void bench_note(Bench *b, const char *scene, const char *what, const char *how, double value);

/* The exponent of `seconds` as a power of `size`: the slope of a line through their logarithms. */
double bench_exponent(const double *size, const double *seconds, int n);

/* Ends the program: a benchmark's own preparations must not fail. */
void bench_need(bool good, const Error *e);

/* A folder of its own for what is written, removed at the end. */
const char *bench_folder(const Bench *b);

/* The parts. */
void bench_crossing(Bench *b);
void bench_evaluation(Bench *b);
void bench_writers(Bench *b);
void bench_frames(Bench *b);
void bench_program(Bench *b);

#endif
