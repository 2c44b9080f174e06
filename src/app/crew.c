/* One motion keeps more than one thread busy before its frames are files: a frame's garments do not
   know of each other. The pieces of a frame stand in the press's list as long as any is to be taken; the
   thread that brought them takes from the front and goes on with the next frame when the last is done. Others
   take from the back, so that a garment mostly stays with the thread that still has it in its cache. */
#include "app/crew.h"

#include "base/clock.h"

struct CrewRound {
    CrewPiece *run;
    void *context;
    PressTally *tally;
    int first, last, left; /* first..last - 1 are to be taken; left: not yet done */
    CrewRound *next; /* in the press's list */
};

/* Takes the next piece of a round and does it. Called and left with the lock held. */
static void take_piece(Press *p, CrewRound *r, Pen *pen, bool as_helper) {
    int piece = as_helper ? --r->last : r->first++;
    pthread_mutex_unlock(p->lock);
    double start = clock_seconds();
    r->run(r->context, piece, pen);
    double seconds = clock_seconds() - start;
    pthread_mutex_lock(p->lock);
    if (as_helper) r->tally->helped += seconds;
    if (--r->left == 0) pthread_cond_broadcast(p->change);
}

static void leave_list(Press *p, const CrewRound *r) {
    CrewRound **at = &p->rounds;
    while (*at != r) at = &(*at)->next;
    *at = r->next;
}

bool crew_help(Press *p, Pen *pen) {
    CrewRound *r = p->rounds;
    while (r && r->first == r->last) r = r->next;
    if (r) take_piece(p, r, pen, true);
    return r != NULL;
}

void crew_do(Press *p, Pen *pen, PressTally *tally, CrewPiece *run, void *context, int count) {
    if (!p->nsheets || count == 1) { /* nobody helps */
        for (int i = 0; i < count; i++) run(context, i, pen);
        return;
    }
    CrewRound round = {.run = run, .context = context, .tally = tally, .last = count, .left = count};
    pthread_mutex_lock(p->lock);
    round.next = p->rounds;
    p->rounds = &round;
    pthread_cond_broadcast(p->change);
    while (round.first < round.last) take_piece(p, &round, pen, false);
    while (round.left > 0)
        if (!press_write_own(p, pen, tally)) press_wait(p, tally);
    leave_list(p, &round);
    pthread_mutex_unlock(p->lock);
}
