/* Instead of Simulink's simulink.c, which cdpr_sfun.c includes at its end: a simulation that prints bits.
 *
 *     cdpr_sfun ROBOT X Y Z STEPS */
#include <inttypes.h>
#include <math.h>
#include <stdio.h>

enum { MOST_CABLES = 16 };

static void print(const char *name, const double *values, int count)
{
    int i;
    printf("%s", name);
    for (i = 0; i < count; i++) {
        uint64_t bits;
        memcpy(&bits, &values[i], sizeof bits);
        printf(" %016" PRIx64, bits);
    }
    printf("\n");
}

/* Lengths at the pose, which the simulation begins with. */
static void first_lengths(SimStruct *S, const double *position, double *lengths)
{
    CdprPose pose = {{position[0], position[1], position[2]}, {1.0, 0.0, 0.0, 0.0}};
    CdprRobot *robot = robot_of(S);
    CdprCables cables;
    cables.count = (size_t)S->inputs[INPUT_LENGTHS];
    cables.lengths = lengths;
    cables.tensions = NULL;
    if (cdpr_inverse(robot, &pose, NULL, &cables, NULL) != CDPR_STATUS_OK) {
        fprintf(stderr, "%s\n", cdpr_message());
        exit(1);
    }
    cdpr_robot_free(robot);
}

/* The message of a simulation that ends before it begins. */
static void refused(const mxArray *robot, const mxArray *start, const mxArray *time)
{
    SimStruct S = {{robot, start, time}, 0, 3, NULL, {0, 0}, {0, 0, 0}, {NULL, NULL}, {NULL, NULL, NULL}, 0.0,
                   {NULL, NULL}, NULL};
    mdlInitializeSizes(&S);
    mdlTerminate(&S);
    printf("%s\n", S.error == NULL ? "no error" : S.error);
}

int main(int count, char **arguments)
{
    double position[3] = {0.0, 0.0, 0.0}, time = 1e-3, load[7] = {2.0, 1.0, -2.0, 3.0, 0.25, 0.5, -0.25};
    double lengths[MOST_CABLES], pose[7], tensions[MOST_CABLES], status = -1.0;
    int i, k;
    if (count != 6) {
        return 2;
    }
    for (i = 0; i < 3; i++) {
        position[i] = strtod(arguments[2 + i], NULL);
    }
    {
        const mxArray robot = {arguments[1], NULL, 0};
        const mxArray start = {NULL, position, 3}, of_time = {NULL, &time, 1};
        SimStruct S = {{&robot, &start, &of_time}, 0, 3, NULL, {0, 0}, {0, 0, 0}, {lengths, load},
                       {pose, tensions, &status}, 0.0, {NULL, NULL}, NULL};
        mdlInitializeSizes(&S);
        if (S.error != NULL || S.inputs[INPUT_LENGTHS] > MOST_CABLES) {
            fprintf(stderr, "%s\n", S.error);
            return 1;
        }
        mdlInitializeSampleTimes(&S);
        first_lengths(&S, position, lengths);
        mdlStart(&S);
        for (k = 0; k <= strtol(arguments[5], NULL, 10); k++) {
            mdlOutputs(&S, 0);
            print("pose", pose, S.outputs[OUTPUT_POSE]);
            print("tensions", tensions, S.outputs[OUTPUT_TENSIONS]);
            print("status", &status, S.outputs[OUTPUT_STATUS]);
            lengths[0] -= 1e-5;
        }
        lengths[0] = NAN;
        mdlOutputs(&S, 0);
        print("pose", pose, 7);
        print("status", &status, 1);
        mdlTerminate(&S);
        printf("%g s, %s\n", S.sample_time, S.error == NULL ? "no error" : S.error);
        refused(&start, &start, &of_time);
    }
    {
        const mxArray robot = {"no robot", NULL, 0}, of_time = {NULL, &time, 1};
        refused(&robot, &of_time, &of_time);
    }
    return 0;
}
