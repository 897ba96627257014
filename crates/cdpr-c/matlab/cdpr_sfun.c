/* S-function for Simulink: the pose of the platform from the lengths of its cables, at each sample.
 *
 *     mex -I/opt/cdpr/include cdpr_sfun.c /opt/cdpr/lib/libcdpr.a -lpthread -ldl -lm
 *
 * Parameters of the block: the robot (a name of the library, or the text of a robot file), a pose near the
 * first one ([x y z] or [x y z qw qx qy qz]), the sample time [s].
 * Inputs:  unstrained lengths [m], one for each cable; load [payload fx fy fz mx my mz] [kg, N, N m].
 * Outputs: pose [x y z qw qx qy qz]; tensions at the platform [N]; status (0 is good, CdprStatus in cdpr.h).
 *
 * The first sample creates the tracker, which ends the simulation where it fails. Later samples allocate
 * nothing; where one fails, the outputs are those of the last good sample, and the status says why. */
#define S_FUNCTION_NAME cdpr_sfun
#define S_FUNCTION_LEVEL 2
#include "simstruc.h"
#include <cdpr.h>
#include <string.h>

enum { PARAMETER_ROBOT, PARAMETER_START, PARAMETER_SAMPLE_TIME, PARAMETERS };
enum { INPUT_LENGTHS, INPUT_LOAD, INPUTS };
enum { OUTPUT_POSE, OUTPUT_TENSIONS, OUTPUT_STATUS, OUTPUTS };
enum { WORK_ROBOT, WORK_TRACKER, WORKS };
enum { POSE_WIDTH = 7, LOAD_WIDTH = 7 };

/* The robot of the block; null with an error of the simulation where there is none. */
static CdprRobot *robot_of(SimStruct *S)
{
    const mxArray *array = ssGetSFcnParam(S, PARAMETER_ROBOT);
    char *text = mxIsChar(array) ? mxArrayToString(array) : NULL;
    CdprRobot *robot = NULL;
    if (text == NULL) {
        ssSetErrorStatus(S, "the first parameter is the name of a robot or the text of a robot file");
        return NULL;
    }
    if ((text[0] == '{' ? cdpr_robot_from_json(text, strlen(text), &robot) : cdpr_robot_named(text, &robot))
        != CDPR_STATUS_OK) {
        ssSetErrorStatus(S, cdpr_message());
    }
    mxFree(text);
    return robot;
}

/* The second parameter; 0 where it is not a pose. */
static int start_of(SimStruct *S, CdprPose *pose)
{
    const mxArray *array = ssGetSFcnParam(S, PARAMETER_START);
    const size_t count = mxGetNumberOfElements(array);
    const CdprPose level = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}};
    *pose = level;
    if (!mxIsDouble(array) || (count != 3 && count != POSE_WIDTH)) {
        ssSetErrorStatus(S, "the second parameter is a pose, [x y z] or [x y z qw qx qy qz]");
        return 0;
    }
    memcpy(pose->position, mxGetPr(array), sizeof pose->position);
    if (count == POSE_WIDTH) {
        memcpy(pose->quaternion, mxGetPr(array) + 3, sizeof pose->quaternion);
    }
    return 1;
}

static void mdlInitializeSizes(SimStruct *S)
{
    CdprRobot *robot;
    int cables, i;
    ssSetNumSFcnParams(S, PARAMETERS);
    if (ssGetNumSFcnParams(S) != ssGetSFcnParamsCount(S)) {
        return; /* Simulink reports it. */
    }
    for (i = 0; i < PARAMETERS; i++) {
        ssSetSFcnParamTunable(S, i, 0);
    }
    robot = robot_of(S);
    if (robot == NULL) {
        return;
    }
    cables = (int)cdpr_robot_cables(robot);
    cdpr_robot_free(robot);
    if (!ssSetNumInputPorts(S, INPUTS) || !ssSetNumOutputPorts(S, OUTPUTS)) {
        return;
    }
    ssSetInputPortWidth(S, INPUT_LENGTHS, cables);
    ssSetInputPortWidth(S, INPUT_LOAD, LOAD_WIDTH);
    for (i = 0; i < INPUTS; i++) {
        ssSetInputPortDirectFeedThrough(S, i, 1);
        ssSetInputPortRequiredContiguous(S, i, 1);
    }
    ssSetOutputPortWidth(S, OUTPUT_POSE, POSE_WIDTH);
    ssSetOutputPortWidth(S, OUTPUT_TENSIONS, cables);
    ssSetOutputPortWidth(S, OUTPUT_STATUS, 1);
    ssSetNumSampleTimes(S, 1);
    ssSetNumPWork(S, WORKS);
}

static void mdlInitializeSampleTimes(SimStruct *S)
{
    ssSetSampleTime(S, 0, mxGetScalar(ssGetSFcnParam(S, PARAMETER_SAMPLE_TIME)));
    ssSetOffsetTime(S, 0, 0.0);
}

#define MDL_START
static void mdlStart(SimStruct *S)
{
    ssSetPWorkValue(S, WORK_ROBOT, robot_of(S));
    ssSetPWorkValue(S, WORK_TRACKER, NULL);
}

/* The first sample: an equilibrium near the pose of the block. */
static CdprStatus begin(SimStruct *S, const double *lengths, size_t count, const CdprLoad *load)
{
    CdprTracker *tracker = NULL;
    CdprPose start;
    CdprStatus status;
    if (!start_of(S, &start)) {
        return CDPR_STATUS_INVALID;
    }
    status = cdpr_tracker_new((const CdprRobot *)ssGetPWorkValue(S, WORK_ROBOT), lengths, count, load, &start,
                              &tracker);
    if (status != CDPR_STATUS_OK) {
        ssSetErrorStatus(S, cdpr_message());
    }
    ssSetPWorkValue(S, WORK_TRACKER, tracker);
    return status;
}

static void mdlOutputs(SimStruct *S, int_T tid)
{
    const double *lengths = ssGetInputPortRealSignal(S, INPUT_LENGTHS);
    const double *values = ssGetInputPortRealSignal(S, INPUT_LOAD);
    const size_t count = (size_t)ssGetInputPortWidth(S, INPUT_LENGTHS);
    double *to = ssGetOutputPortRealSignal(S, OUTPUT_POSE);
    CdprTracker *tracker = (CdprTracker *)ssGetPWorkValue(S, WORK_TRACKER);
    CdprLoad load;
    CdprPose pose;
    CdprStatus status;
    (void)tid;
    load.payload = values[0];
    memcpy(load.force, values + 1, sizeof load.force);
    memcpy(load.moment, values + 4, sizeof load.moment);
    status = tracker == NULL ? begin(S, lengths, count, &load)
                             : cdpr_tracker_step(tracker, lengths, count, &load, NULL);
    *ssGetOutputPortRealSignal(S, OUTPUT_STATUS) = (double)status;
    tracker = (CdprTracker *)ssGetPWorkValue(S, WORK_TRACKER);
    if (tracker == NULL) {
        return; /* The simulation ends. */
    }
    cdpr_tracker_state(tracker, &pose, ssGetOutputPortRealSignal(S, OUTPUT_TENSIONS), count);
    memcpy(to, pose.position, sizeof pose.position);
    memcpy(to + 3, pose.quaternion, sizeof pose.quaternion);
}

static void mdlTerminate(SimStruct *S)
{
    if (ssGetPWork(S) != NULL) { /* Simulink may end before it has given the memory. */
        cdpr_tracker_free((CdprTracker *)ssGetPWorkValue(S, WORK_TRACKER));
        cdpr_robot_free((CdprRobot *)ssGetPWorkValue(S, WORK_ROBOT));
        ssSetPWorkValue(S, WORK_TRACKER, NULL);
        ssSetPWorkValue(S, WORK_ROBOT, NULL);
    }
}

#ifdef MATLAB_MEX_FILE
#include "simulink.c"
#else
#include "cg_sfun.h"
#endif
