/* Normative sagittal angles of 20 adults (22 to 72 years) at self-selected speed: Bovi,
   Rabuffetti, Mazzoleni, Ferrarin, "A multiple-task gait analysis approach: kinematic, kinetic
   and EMG reference data for healthy young and adult subjects", Gait & Posture 33 (2011) 6-13.
   Group means every 2 % of the stride from heel contact, as the gait simulator SCONE bundles
   them; like there, 20 degrees are added to the ankle, so that a flat foot under an upright
   shin has 0 (the marker axis of the foot points that much below the sole). */
#include "motion/gait_curves.h"

#include "geometry/vec.h"

enum { SAMPLES = 50 };

static const double TABLE[GAIT_CURVES][SAMPLES] = {
    [GAIT_CURVE_HIP] = {
        33.0, 32.9, 32.5, 32.0, 31.2, 29.9, 28.1, 26.1, 24.0, 21.9,
        19.7, 17.4, 14.9, 12.4, 9.9, 7.5, 5.2, 3.0, 0.9, -1.1,
        -2.9, -4.5, -5.8, -6.8, -7.6, -8.2, -8.3, -7.8, -6.7, -4.9,
        -2.3, 1.1, 5.0, 9.0, 12.9, 16.7, 20.2, 23.4, 26.3, 28.9,
        30.9, 32.5, 33.4, 33.7, 33.5, 32.8, 32.0, 31.5, 31.4, 31.7,
    },
    [GAIT_CURVE_KNEE] = {
        7.9, 10.3, 11.9, 14.7, 17.4, 19.0, 19.4, 19.0, 18.1, 17.2,
        16.2, 15.1, 14.0, 12.8, 11.5, 10.2, 9.1, 8.1, 7.5, 7.2,
        7.3, 7.7, 8.6, 10.0, 11.9, 14.1, 17.0, 20.6, 25.2, 30.8,
        37.2, 44.0, 50.4, 55.7, 59.8, 62.4, 63.4, 63.0, 61.3, 58.4,
        54.2, 48.9, 42.4, 35.0, 26.8, 18.7, 11.6, 6.5, 4.0, 4.4,
    },
    [GAIT_CURVE_ANKLE] = {
        -2.3, -3.9, -6.2, -6.1, -4.6, -2.5, -0.5, 1.0, 2.3, 3.4,
        4.4, 5.4, 6.4, 7.2, 7.9, 8.6, 9.2, 10.0, 10.7, 11.5,
        12.0, 12.4, 12.4, 12.1, 11.1, 9.4, 6.6, 2.4, -3.4, -9.8,
        -15.3, -18.9, -19.9, -18.0, -14.6, -10.7, -7.3, -4.3, -1.8, 0.0,
        1.4, 2.4, 2.7, 2.4, 1.3, 0.0, -1.1, -1.9, -2.5, -2.7,
    },
};

/* Periodic cubic through the samples (Catmull-Rom). */
double gait_curve(GaitCurve curve, double cycle) {
    double place = (cycle - floor(cycle)) * SAMPLES;
    int i = (int)place % SAMPLES;
    double t = place - floor(place);
    const double *f = TABLE[curve];
    double a = f[(i + SAMPLES - 1) % SAMPLES], b = f[i], c = f[(i + 1) % SAMPLES], d = f[(i + 2) % SAMPLES];
    return b + 0.5 * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)));
}

double gait_pelvis_list(double cycle) {
    return 2.8 * sin(2 * PI * cycle);
}

/* Fitted so that the legs, reaching for feet that do not slide, stay as near as they can to the
   published angles: within 4 degrees. */
double gait_hip_height(double cycle) {
    double a = 4 * PI * cycle;
    return 0.5152 - 0.0082 * cos(a) - 0.0028 * sin(a) - 0.0004 * cos(2 * a);
}
