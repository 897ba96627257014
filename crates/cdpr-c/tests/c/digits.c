/* Prints the bits of all results at a pose and along a path: digits ROBOT X Y Z STEPS [quiet]. */
#include "cdpr.h"
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_CABLES = 16, MOST_INPUTS = 256 };

static int quiet = 0;

static void print(const char *name, const double *values, size_t count)
{
    size_t i;
    if (quiet) {
        return;
    }
    printf("%s", name);
    for (i = 0; i < count; i++) {
        uint64_t bits;
        memcpy(&bits, &values[i], sizeof bits);
        printf(" %016" PRIx64, bits);
    }
    printf("\n");
}

static void print_report(const CdprReport *report)
{
    const double values[5] = {report->closure, report->force, report->moment, (double)report->iterations,
                              (double)report->jump};
    print("report", values, 5);
}

static void print_pose(const CdprPose *pose)
{
    print("position", pose->position, 3);
    print("quaternion", pose->quaternion, 4);
}

static void need(CdprStatus status, const char *call)
{
    if (status != CDPR_STATUS_OK) {
        fprintf(stderr, "%s: status %d: %s\n", call, (int)status, cdpr_message());
        exit(1);
    }
}

static double lengths[MOST_CABLES], tensions[MOST_CABLES];
static double matrix[4][MOST_CABLES * MOST_INPUTS];

static void at_pose(const CdprRobot *robot, const CdprPose *pose, const CdprLoad *load)
{
    const size_t n = cdpr_robot_cables(robot), inputs = cdpr_robot_inputs(robot);
    CdprCables cables = {n, lengths, tensions};
    CdprDerivatives derivatives = {inputs, matrix[0], matrix[1], matrix[2], matrix[3]};
    CdprPose found = *pose;
    CdprMotion motion;
    CdprStiffness stiffness;
    CdprReport report;
    need(cdpr_inverse(robot, pose, NULL, &cables, &report), "inverse");
    print("lengths", lengths, n);
    print("tensions", tensions, n);
    print_report(&report);
    need(cdpr_direct(robot, &cables, load, &found, &report), "direct");
    print_pose(&found);
    print("tensions", tensions, n);
    print_report(&report);
    need(cdpr_deflection(robot, pose, load, &motion, &report), "deflection");
    print("translation", motion.translation, 3);
    print("rotation", motion.rotation, 3);
    print_report(&report);
    need(cdpr_stiffness(robot, pose, load, &stiffness, &report), "stiffness");
    print("stiffness", &stiffness.matrix[0][0], 36);
    print("least", &stiffness.least, 1);
    print_report(&report);
    need(cdpr_derivatives(robot, pose, load, &derivatives, &report), "derivatives");
    print("lengths", matrix[0], n * inputs);
    print("tensions", matrix[1], n * inputs);
    print("displacement", matrix[2], 3 * inputs);
    print("magnitude", matrix[3], inputs);
    print_report(&report);
}

static void along_path(const CdprRobot *robot, const CdprPose *start, const CdprLoad *load, long steps)
{
    const size_t n = cdpr_robot_cables(robot);
    CdprCables cables = {n, lengths, tensions};
    CdprTracker *tracker = NULL;
    CdprPath *path = NULL;
    CdprPose pose = *start;
    CdprReport report;
    long k;
    need(cdpr_path_new(robot, &path), "path_new");
    need(cdpr_path_next(path, &pose, NULL, NULL, &cables, &report), "path_next");
    need(cdpr_tracker_new(robot, lengths, n, load, &pose, &tracker), "tracker_new");
    for (k = 1; k <= steps; k++) {
        /* There and back, so that any number of steps stays near the start. */
        const long along = k % 400 < 200 ? k % 400 : 400 - k % 400;
        pose.position[0] = start->position[0] + 0.0005 * (double)along;
        need(cdpr_path_next(path, &pose, NULL, NULL, &cables, &report), "path_next");
        print("lengths", lengths, n);
        print_report(&report);
        need(cdpr_tracker_step(tracker, lengths, n, load, &report), "tracker_step");
        print_report(&report);
        {
            CdprPose found;
            need(cdpr_tracker_state(tracker, &found, tensions, n), "tracker_state");
            print_pose(&found);
        }
        print("tensions", tensions, n);
    }
    cdpr_tracker_free(tracker);
    cdpr_path_free(path);
}

/* Calls that have to fail, each with its status and a message. */
static void bad_calls(const CdprRobot *robot, const CdprPose *pose)
{
    CdprRobot *other = NULL;
    CdprCables cables = {cdpr_robot_cables(robot) + 1, lengths, NULL};
    const CdprStatus found[4] = {cdpr_robot_named(NULL, &other), cdpr_robot_named("no robot", &other),
                                 cdpr_inverse(robot, pose, NULL, &cables, NULL),
                                 cdpr_robot_from_json("{", 1, &other)};
    const CdprStatus expected[4] = {CDPR_STATUS_POINTER, CDPR_STATUS_ROBOT, CDPR_STATUS_SIZE,
                                    CDPR_STATUS_ROBOT};
    int i;
    for (i = 0; i < 4; i++) {
        if (found[i] != expected[i] || cdpr_message()[0] == '\0') {
            fprintf(stderr, "bad call %d: status %d\n", i, (int)found[i]);
            exit(1);
        }
    }
}

int main(int count, char **arguments)
{
    CdprRobot *robot = NULL;
    CdprPose pose = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}};
    const CdprLoad load = {2.0, {1.0, -2.0, 3.0}, {0.25, 0.5, -0.25}};
    int i;
    if (count < 6) {
        fprintf(stderr, "usage: digits ROBOT X Y Z STEPS [quiet]\n");
        return 2;
    }
    quiet = count > 6;
    need(cdpr_robot_named(arguments[1], &robot), "robot_named");
    if (cdpr_robot_cables(robot) > MOST_CABLES || cdpr_robot_inputs(robot) > MOST_INPUTS) {
        fprintf(stderr, "too many cables\n");
        return 2;
    }
    for (i = 0; i < 3; i++) {
        pose.position[i] = strtod(arguments[2 + i], NULL);
    }
    bad_calls(robot, &pose);
    at_pose(robot, &pose, &load);
    along_path(robot, &pose, &load, strtol(arguments[5], NULL, 10));
    cdpr_robot_free(robot);
    return 0;
}
