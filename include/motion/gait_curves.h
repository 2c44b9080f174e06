/* Published joint angles of walking over one stride. */
#ifndef MOTION_GAIT_CURVES_H
#define MOTION_GAIT_CURVES_H

/* Hip and knee: flexion positive; ankle: dorsiflexion positive. */
typedef enum { GAIT_CURVE_HIP, GAIT_CURVE_KNEE, GAIT_CURVE_ANKLE, GAIT_CURVES } GaitCurve;

/* Clinical gait analysis measures the hip against a pelvis whose own axes stand this many
   degrees forward in quiet standing; the walker's zero pose is the standing one, so its hip
   angle is the published one less this. */
#define GAIT_PELVIC_TILT 9.0

/* Mean angle of healthy adults at natural speed, degrees, as published. cycle: strides since
   the heel touched the ground; any real number. */
double gait_curve(GaitCurve curve, double cycle);

/* How far the pelvis lists to the side of the standing leg, degrees (Perry and Burnfield 2010:
   4 to 5; less here, so that both legs stay with their published angles). */
double gait_pelvis_list(double cycle);

/* Height of the middle of the hips over the sole of the standing foot, in statures, that these
   angles imply when they are put on the walker's body: the first two waves of it. */
double gait_hip_height(double cycle);

#endif
