/* The monotonic clock, for the columns that end in _s. */
#ifndef BASE_CLOCK_H
#define BASE_CLOCK_H

/* Seconds since some fixed moment. */
double clock_seconds(void);

/* Seconds since *since, which moves on to now. */
double clock_lap(double *since);

#endif
