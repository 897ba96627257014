/* libcdpr: elasto-statics of cable-driven parallel robots. SI units throughout; docs/c.md explains the use.
 *
 * Any number of threads at a time may call the functions that take a robot or no handle. A tracker, a path or an observer
 * belongs to one thread at a time. */

#ifndef CDPR_H
#define CDPR_H

/* Made by cbindgen of crates/cdpr-c/src: do not edit. */

#include <stddef.h>
#include <stdint.h>

/**
 * How a call has ended.
 */
typedef enum CdprStatus {
    /**
     * The results are written.
     */
    CDPR_STATUS_OK = 0,
    /**
     * A pointer is null or not aligned.
     */
    CDPR_STATUS_POINTER = 1,
    /**
     * The number of values is not that of the robot's cables or inputs.
     */
    CDPR_STATUS_SIZE = 2,
    /**
     * A value is NaN, infinite or out of its range.
     */
    CDPR_STATUS_INVALID = 3,
    /**
     * The text is not a robot, or no robot of the library has this name.
     */
    CDPR_STATUS_ROBOT = 4,
    /**
     * The function does not take this kind of robot.
     */
    CDPR_STATUS_UNSUPPORTED = 5,
    /**
     * There is no result: the pose is infeasible, a cable is overstrained, or a derivative does not exist.
     */
    CDPR_STATUS_NO_SOLUTION = 6,
    /**
     * The equilibrium is unstable or is lost on the way to the load.
     */
    CDPR_STATUS_UNSTABLE = 7,
    /**
     * The iterations did not converge. A tracker or an observer keeps its last state.
     */
    CDPR_STATUS_NOT_CONVERGED = 8,
    /**
     * A fault of the library. Free the handle of the call, and report the message.
     */
    CDPR_STATUS_PANIC = 9,
} CdprStatus;

/**
 * What the readings say that the model does not.
 */
typedef enum CdprAlarm {
    /**
     * Nothing.
     */
    CDPR_ALARM_NONE = 0,
    /**
     * The load has changed by more than the estimate allowed.
     */
    CDPR_ALARM_LOAD_CHANGED = 1,
    /**
     * A cable reads no tension although the model has it taut, and no plausible load explains the readings: it is
     * broken, slack or off its pulley, or its sensor has failed.
     */
    CDPR_ALARM_CABLE_LOST = 2,
    /**
     * No plausible load explains the readings, and no cable stands out.
     */
    CDPR_ALARM_INCONSISTENT = 3,
    /**
     * Another load explains the readings, and a cable reads no tension although the model had it taut with the
     * load before: it has become slack, or it is broken and the robot has too few cables to distinguish these.
     */
    CDPR_ALARM_CABLE_SLACK = 4,
} CdprAlarm;

/**
 * Observes the load and the cables from lengths and measured tensions: the handle of `cdpr_observer_new`. One
 * thread at a time may use it.
 */
typedef struct CdprObserver CdprObserver;

/**
 * Lengths and tensions along a path of poses: the handle of `cdpr_path_new`. One thread at a time may use
 * it.
 */
typedef struct CdprPath CdprPath;

/**
 * A robot: the handle of `cdpr_robot_named` and `cdpr_robot_from_json`. It does not change, and any number
 * of threads may use it. Trackers and paths remain valid when it is freed.
 */
typedef struct CdprRobot CdprRobot;

/**
 * Follows the pose of the platform while lengths and load change: the handle of `cdpr_tracker_new`. One
 * thread at a time may use it.
 */
typedef struct CdprTracker CdprTracker;

/**
 * Pose of the platform in the base frame.
 */
typedef struct CdprPose {
    /**
     * Position of the reference point P [m].
     */
    double position[3];
    /**
     * Rotation as a unit quaternion (w, x, y, z); (1, 0, 0, 0) where the platform is level.
     */
    double quaternion[4];
} CdprPose;

/**
 * Load on the platform in addition to its own weight.
 */
typedef struct CdprLoad {
    /**
     * Mass added at the platform's centre of mass [kg].
     */
    double payload;
    /**
     * Force in the base frame [N].
     */
    double force[3];
    /**
     * Moment about P in the base frame [N m].
     */
    double moment[3];
} CdprLoad;

/**
 * Where a call reads or writes a value of each cable.
 */
typedef struct CdprCables {
    /**
     * Number of values of each list: that of the cables.
     */
    size_t count;
    /**
     * Unstrained lengths [m].
     */
    double *lengths;
    /**
     * Tensions at the platform [N]. They are not written where this is null.
     */
    double *tensions;
} CdprCables;

/**
 * How exact a result is and how it was found.
 */
typedef struct CdprReport {
    /**
     * Largest distance between the end of a cable and its anchor point [m].
     */
    double closure;
    /**
     * Unbalanced force on the platform [N].
     */
    double force;
    /**
     * Unbalanced moment about P [N m].
     */
    double moment;
    /**
     * Iterations that were made.
     */
    uint32_t iterations;
    /**
     * 1 where a path has left its branch, so that its lengths may jump, else 0.
     */
    uint32_t jump;
} CdprReport;

/**
 * Motion of the platform in the base frame.
 */
typedef struct CdprMotion {
    /**
     * Displacement of P [m].
     */
    double translation[3];
    /**
     * Rotation vector [rad].
     */
    double rotation[3];
} CdprMotion;

/**
 * Stiffness of the platform at a pose.
 */
typedef struct CdprStiffness {
    /**
     * Matrix of (dp, dphi) [N/m, N/rad, N, N m/rad], row by row.
     */
    double matrix[6][6];
    /**
     * Stiffness of the softest motion [N/m].
     */
    double least;
    /**
     * 1 where the equilibrium is stable, else 0.
     */
    uint32_t is_stable;
} CdprStiffness;

/**
 * Where derivatives are written, row by row with a column for each input, per SI unit of the input.
 *
 * The inputs are the parameters of the robot, the payload and the six coordinates of the pose. A matrix
 * whose pointer is null is not written. Where the derivatives on both sides differ, because a tension is at
 * its limit, it is that for a decreasing input.
 */
typedef struct CdprDerivatives {
    /**
     * Number of columns: that of `cdpr_robot_inputs`.
     */
    size_t inputs;
    /**
     * Unstrained lengths, a row for each cable [m per unit].
     */
    double *lengths;
    /**
     * Tensions that set the lengths, a row for each cable [N per unit].
     */
    double *tensions;
    /**
     * Displacement under the load, three rows [m per unit].
     */
    double *displacement;
    /**
     * Norm of the displacement, one row [m per unit].
     */
    double *magnitude;
} CdprDerivatives;

/**
 * Noise, prior knowledge and alarms of an observer.
 */
typedef struct CdprObserverSetting {
    /**
     * Number of cables.
     */
    size_t count;
    /**
     * Standard deviation of the tension that the sensor of each cable reads [N].
     */
    const double *tension_std;
    /**
     * Standard deviation of each unstrained length [m]; 0 where lengths count as exact.
     */
    double length_std;
    /**
     * Standard deviation of the load before the first sample [kg]; its mean is no load.
     */
    double payload_std;
    /**
     * Standard deviation of the distance between the load's centre and that of the platform along each axis [m].
     */
    double center_std;
    /**
     * Standard deviation of the modulus as a share of the robot's, 0 to 0.15; 0 where it is known.
     */
    double modulus_std;
    /**
     * Number of samples after which a sample has lost most of its weight; infinite for none that loses any.
     */
    double memory;
    /**
     * Probability that an alarm begins at a sample although nothing is wrong, 1e-15 to 0.1, such as 1e-9.
     */
    double false_alarm;
    /**
     * Number of samples in a row that have to deviate for an alarm, such as 3.
     */
    size_t consecutive;
} CdprObserverSetting;

/**
 * What a sample says, and what is known after it.
 */
typedef struct CdprObserved {
    /**
     * Force that the measured tensions hold in addition to the platform's weight, in the base frame [N].
     */
    double force[3];
    /**
     * Its moment about P [N m].
     */
    double moment[3];
    /**
     * Mass of the load [kg].
     */
    double payload;
    /**
     * Standard deviation of the mass [kg].
     */
    double payload_std;
    /**
     * Centre of the load in the frame of the platform, from P [m]; NaN where the load is below three times its
     * standard deviation, or where the samples have not halved the uncertainty of its moment.
     */
    double center[3];
    /**
     * Standard deviation of the centre [m]; NaN where the centre is.
     */
    double center_std[3];
    /**
     * Modulus of the cables as a multiple of the robot's.
     */
    double modulus;
    /**
     * Standard deviation of the modulus.
     */
    double modulus_std;
    /**
     * Chi-square of the readings for the best plausible load; NaN while taring.
     */
    double consistency;
    /**
     * Chi-square of the readings for the load that was known before; NaN while taring.
     */
    double change;
    /**
     * The value beyond which a chi-square deviates.
     */
    double threshold;
    /**
     * The cable of `CDPR_ALARM_CABLE_LOST` or `CDPR_ALARM_CABLE_SLACK`, from 0.
     */
    size_t cable;
    /**
     * What the last samples in a row say.
     */
    enum CdprAlarm alarm;
    /**
     * Iterations that were made, at most 12.
     */
    uint32_t iterations;
} CdprObserved;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/**
 * The version of the library.
 */
const char *cdpr_version(void);

/**
 * The message of the last call of this thread that did not return CDPR_STATUS_OK; it is empty before the
 * first one. It is valid until the next such call of this thread.
 */
const char *cdpr_message(void);

/**
 * Creates the robot of the library with this name, such as "caroca".
 *
 * Where a function that creates a handle fails, the handle is null.
 */
enum CdprStatus cdpr_robot_named(const char *name, struct CdprRobot **robot);

/**
 * Creates the robot of a file cdpr-robot/1, whose text has `size` bytes.
 */
enum CdprStatus cdpr_robot_from_json(const char *text, size_t size, struct CdprRobot **robot);

/**
 * Frees a robot; null is ignored.
 */
void cdpr_robot_free(struct CdprRobot *robot);

/**
 * The number of cables; 0 for null.
 */
size_t cdpr_robot_cables(const struct CdprRobot *robot);

/**
 * The number of inputs by which derivatives are taken: the parameters, the payload and the six coordinates
 * of the pose; 0 for null.
 */
size_t cdpr_robot_inputs(const struct CdprRobot *robot);

/**
 * The name of an input, from 0, such as "mass" or "b1.z"; null beyond the last one. It is valid until the
 * robot is freed.
 */
const char *cdpr_robot_input(const struct CdprRobot *robot, size_t index);

/**
 * Writes the unstrained lengths and the tensions that hold a pose under the platform's weight and `load`.
 *
 * `load` may be null for none, and `report` where it is not wanted, here and below.
 */
enum CdprStatus cdpr_inverse(const struct CdprRobot *robot,
                             const struct CdprPose *pose,
                             const struct CdprLoad *load,
                             const struct CdprCables *cables,
                             struct CdprReport *report);

/**
 * Writes the pose and the tensions of the equilibrium for `cables.lengths` near `pose`, or to which the
 * platform descends from it: the result overwrites `pose`.
 */
enum CdprStatus cdpr_direct(const struct CdprRobot *robot,
                            const struct CdprCables *cables,
                            const struct CdprLoad *load,
                            struct CdprPose *pose,
                            struct CdprReport *report);

/**
 * Writes the motion of the platform under `load`, with the lengths that hold `pose` without it.
 */
enum CdprStatus cdpr_deflection(const struct CdprRobot *robot,
                                const struct CdprPose *pose,
                                const struct CdprLoad *load,
                                struct CdprMotion *motion,
                                struct CdprReport *report);

/**
 * Writes the stiffness at a pose that the inverse model holds under the platform's weight and `load`.
 */
enum CdprStatus cdpr_stiffness(const struct CdprRobot *robot,
                               const struct CdprPose *pose,
                               const struct CdprLoad *load,
                               struct CdprStiffness *result,
                               struct CdprReport *report);

/**
 * Writes the derivatives of lengths, tensions and deflection by all inputs.
 */
enum CdprStatus cdpr_derivatives(const struct CdprRobot *robot,
                                 const struct CdprPose *pose,
                                 const struct CdprLoad *load,
                                 const struct CdprDerivatives *result,
                                 struct CdprReport *report);

/**
 * Creates a tracker at the equilibrium for these lengths and this load near `start`, or to which the platform
 * descends from it.
 */
enum CdprStatus cdpr_tracker_new(const struct CdprRobot *robot,
                                 const double *lengths,
                                 size_t count,
                                 const struct CdprLoad *load,
                                 const struct CdprPose *start,
                                 struct CdprTracker **tracker);

/**
 * Goes to the equilibrium for other lengths and another load, in at most 12 iterations.
 *
 * Nothing is allocated for up to 16 cables (4 on x86-64 without AVX2). Where the iterations do not converge,
 * the last state is kept, and `report` has its residuals with the number of iterations made.
 */
enum CdprStatus cdpr_tracker_step(struct CdprTracker *tracker,
                                  const double *lengths,
                                  size_t count,
                                  const struct CdprLoad *load,
                                  struct CdprReport *report);

/**
 * Writes the pose of the tracker and, where `tensions` is not null, the tensions at the platform.
 */
enum CdprStatus cdpr_tracker_state(const struct CdprTracker *tracker,
                                   struct CdprPose *pose,
                                   double *tensions,
                                   size_t count);

/**
 * Writes points of a cable, from 0, in the state of the tracker: x, y, z of each in the base frame [m], at
 * equal distances along the cable from its exit point, or where it leaves its pulley, to its anchor point.
 *
 * `points` has room for 3 `count` values; `count` is 2 to 1000. Memory is allocated.
 */
enum CdprStatus cdpr_tracker_shape(const struct CdprTracker *tracker,
                                   size_t cable,
                                   double *points,
                                   size_t count);

/**
 * Frees a tracker; null is ignored.
 */
void cdpr_tracker_free(struct CdprTracker *tracker);

/**
 * Creates an observer of a robot that rests without load with these lengths near `start`.
 */
enum CdprStatus cdpr_observer_new(const struct CdprRobot *robot,
                                  const double *lengths,
                                  size_t count,
                                  const struct CdprPose *start,
                                  const struct CdprObserverSetting *setting,
                                  struct CdprObserver **observer);

/**
 * Takes a sample without load: the mean difference between tensions and model over all such samples is the
 * constant error of each sensor, which later samples subtract.
 *
 * `observed` may be null. Nothing is allocated, here and in `cdpr_observer_update`.
 */
enum CdprStatus cdpr_observer_tare(struct CdprObserver *observer,
                                   const double *lengths,
                                   const double *tensions,
                                   size_t count,
                                   struct CdprObserved *observed);

/**
 * Takes a sample: unstrained lengths and measured tensions at the platform.
 *
 * Where no rest is found for the lengths within 12 iterations of the last one, the sample changes nothing.
 */
enum CdprStatus cdpr_observer_update(struct CdprObserver *observer,
                                     const double *lengths,
                                     const double *tensions,
                                     size_t count,
                                     struct CdprObserved *observed);

/**
 * Writes what the last samples say about each cable: 0 it is taut, 1 it reads no more than noise and its own
 * weight as the model allows, 2 it reads no more than that although the model has it taut.
 */
enum CdprStatus cdpr_observer_cables(const struct CdprObserver *observer, uint8_t *states, size_t count);

/**
 * Frees an observer; null is ignored.
 */
void cdpr_observer_free(struct CdprObserver *observer);

/**
 * Creates a path, whose first pose is the next one. Robots with fewer cables than free motions are refused.
 */
enum CdprStatus cdpr_path_new(const struct CdprRobot *robot, struct CdprPath **path);

/**
 * Allows no tension to change by more than `change` [N] from one pose to the next; infinity is no limit.
 */
enum CdprStatus cdpr_path_limit_change(struct CdprPath *path, double change);

/**
 * Writes lengths and tensions at the next pose of a path, on the branch of the last ones.
 *
 * The tensions are those nearest to `reference`, one for each cable [N], such as measured ones; null stands
 * for the preferred ones of the robot. Where the branch ends, `report.jump` is 1. After a failure the path
 * continues from the last pose with a solution.
 */
enum CdprStatus cdpr_path_next(struct CdprPath *path,
                               const struct CdprPose *pose,
                               const struct CdprLoad *load,
                               const double *reference,
                               const struct CdprCables *cables,
                               struct CdprReport *report);

/**
 * Frees a path; null is ignored.
 */
void cdpr_path_free(struct CdprPath *path);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* CDPR_H */
