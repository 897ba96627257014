/* A control loop of 1 kHz: lengths for the next pose of a circle, and the pose that the measured lengths mean.
 *
 *     cc control_loop.c $(pkg-config --cflags --libs cdpr) -lm -o control_loop
 */
#define _POSIX_C_SOURCE 200809L
#include <cdpr.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { CABLES = 8, CYCLES = 1000 };

static const double TWO_PI = 6.283185307179586;

/* Ends the program where a call fails: a controller would hold the platform instead. */
static void need(CdprStatus status)
{
    if (status != CDPR_STATUS_OK) {
        fprintf(stderr, "status %d: %s\n", (int)status, cdpr_message());
        exit(1);
    }
}

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void wait_until(double time)
{
    struct timespec until;
    until.tv_sec = (time_t)time;
    until.tv_nsec = (long)(1e9 * (time - (double)until.tv_sec));
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, NULL);
}

int main(void)
{
    CdprRobot *robot = NULL;
    CdprPath *path = NULL;
    CdprTracker *tracker = NULL;
    CdprPose wanted = {{0.2, 0.0, 1.75}, {1.0, 0.0, 0.0, 0.0}}, found;
    const CdprLoad load = {50.0, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}}; /* what the platform carries [kg, N, N m] */
    double lengths[CABLES], tensions[CABLES], farthest = 0.0, longest = 0.0, start;
    CdprCables cables = {CABLES, lengths, tensions};
    CdprReport report;
    int cycle, i, kept = 0;

    /* Everything is created before the loop. */
    need(cdpr_robot_named("caroca", &robot));
    need(cdpr_path_new(robot, &path));
    need(cdpr_path_next(path, &wanted, NULL, NULL, &cables, &report));
    need(cdpr_tracker_new(robot, lengths, CABLES, &load, &wanted, &tracker));

    start = seconds();
    for (cycle = 1; cycle <= CYCLES; cycle++) {
        const double angle = TWO_PI * cycle / CYCLES;
        double begin, time, off = 0.0;
        CdprStatus status;
        wait_until(start + 1e-3 * cycle);

        /* The set-points: lengths that hold the wanted pose, on the branch of those before. */
        wanted.position[0] = 0.2 * cos(angle);
        wanted.position[1] = 0.2 * sin(angle);
        need(cdpr_path_next(path, &wanted, NULL, NULL, &cables, &report));

        /* The winches would follow `lengths`; what their encoders measure means this pose under the load. */
        begin = seconds();
        status = cdpr_tracker_step(tracker, lengths, CABLES, &load, &report);
        time = seconds() - begin;
        if (status == CDPR_STATUS_NOT_CONVERGED) {
            kept++; /* The tracker has kept its last state. */
        } else {
            need(status);
        }
        need(cdpr_tracker_state(tracker, &found, tensions, CABLES));
        for (i = 0; i < 3; i++) {
            const double difference = found.position[i] - wanted.position[i];
            off += difference * difference;
        }
        farthest = sqrt(off) > farthest ? sqrt(off) : farthest;
        longest = time > longest ? time : longest;
    }
    printf("pose (%.6f, %.6f, %.6f) m, tension of cable 1 %.3f N\n", found.position[0], found.position[1],
           found.position[2], tensions[0]);
    printf("%d cycles, %d without convergence, deflection up to %.4f mm\n", CYCLES, kept, 1e3 * farthest);
    fprintf(stderr, "longest step %.1f us\n", 1e6 * longest);

    cdpr_tracker_free(tracker);
    cdpr_path_free(path);
    cdpr_robot_free(robot);
    return 0;
}
