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

/* The same, with something before each run that does not count. */
Timing bench_time_after(void (*before)(void *context), void (*run)(void *context), void *context);

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

/* A number that is no time, such as a share. `most`: what it should not exceed; 0: anything. */
void bench_note(Bench *b, const char *scene, const char *what, const char *how, double value, double most);

/* A thing that was done in growing sizes. Entered are the time of each unit at each size, and the exponent of
   time as a power of size: the slope of a line through their logarithms. */
enum { SERIES_MAX = 16 };
typedef struct {
    const char *what, *unit;
    int n;
    double size[SERIES_MAX], seconds[SERIES_MAX];
    double most;            /* the exponent should not exceed; 0: any */
} BenchSeries;
void bench_add(BenchSeries *s, double size, double seconds);
void bench_series(Bench *b, const BenchSeries *s);
double bench_exponent(const BenchSeries *s);

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
