/* What load cells say: the mass of a load and its centre, and a cable that breaks.
 *
 *     cc load_observer.c $(pkg-config --cflags --libs cdpr) -lm -o load_observer
 */
#include <cdpr.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { CABLES = 8, SAMPLES = 1000 };

static void need(CdprStatus status)
{
    if (status != CDPR_STATUS_OK) {
        fprintf(stderr, "status %d: %s\n", (int)status, cdpr_message());
        exit(1);
    }
}

int main(void)
{
    CdprRobot *robot = NULL;
    CdprObserver *observer = NULL;
    const CdprPose wanted = {{0.2, 0.0, 1.75}, {1.0, 0.0, 0.0, 0.0}};
    CdprPose found = wanted;
    const CdprLoad load = {5.0, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
    double lengths[CABLES], empty[CABLES], loaded[CABLES], noise[CABLES];
    CdprCables cables = {CABLES, lengths, empty};
    CdprObserverSetting setting;
    CdprObserved observed;
    int i;

    need(cdpr_robot_named("caroca", &robot));
    need(cdpr_inverse(robot, &wanted, NULL, &cables, NULL));
    cables.tensions = loaded;
    need(cdpr_direct(robot, &cables, &load, &found, NULL));

    for (i = 0; i < CABLES; i++) {
        noise[i] = 5.0; /* standard deviation of each load cell [N] */
    }
    setting.count = CABLES;
    setting.tension_std = noise;
    setting.length_std = 0.0;
    setting.payload_std = 20.0; /* loads of some 20 kg are plausible */
    setting.center_std = 0.2;
    setting.modulus_std = 0.0;
    setting.memory = INFINITY;
    setting.false_alarm = 1e-9;
    setting.consecutive = 3;
    need(cdpr_observer_new(robot, lengths, CABLES, &wanted, &setting, &observer));

    /* The cells would be read here, once a millisecond. */
    for (i = 0; i < SAMPLES; i++) {
        need(cdpr_observer_tare(observer, lengths, empty, CABLES, NULL));
    }
    for (i = 0; i < SAMPLES; i++) {
        need(cdpr_observer_update(observer, lengths, loaded, CABLES, &observed));
    }
    printf("%.2f kg, standard deviation %.2f kg, weight %.1f N\n", observed.payload, observed.payload_std,
           -observed.force[2]);

    loaded[2] = 0.0; /* the cell of cable 3 reads nothing more */
    for (i = 1; i <= 10; i++) {
        need(cdpr_observer_update(observer, lengths, loaded, CABLES, &observed));
        if (observed.alarm == CDPR_ALARM_CABLE_LOST) {
            printf("cable %d is lost, after %d samples\n", (int)observed.cable + 1, i);
            break;
        }
    }

    cdpr_observer_free(observer);
    cdpr_robot_free(robot);
    return 0;
}
