/* C interface of MUFASA's implementation: see capi/README.md.
 *
 * Generated from capi/src; UPDATE_HEADER=1 cargo test -p mufasa-capi --test header writes it anew. */

#ifndef MUFASA_H
#define MUFASA_H

#include <stddef.h>
#include <stdint.h>

/* Every status has to be looked at. */
#if defined(__GNUC__) || defined(__clang__)
#define MUFASA_MUST_USE __attribute__((warn_unused_result))
#else
#define MUFASA_MUST_USE
#endif

/* A number that is initialised as a pointer, as C forbids: `{50}` is no MufasaTime. Newer compilers refuse it anyway. */
#if defined(__GNUC__) && !defined(__cplusplus)
#pragma GCC diagnostic error "-Wint-conversion"
#endif

// First number of the version of this interface; `mufasa_version` says that of the library.
#define MUFASA_VERSION_MAJOR 0

// Second number.
#define MUFASA_VERSION_MINOR 2

// Third number.
#define MUFASA_VERSION_PATCH 0

// Bytes of the texts of MufasaInvalidInput, the closing 0 included.
#define MUFASA_TEXT_BYTES 96

// Bytes of scratch memory that are enough for every cycle.
#define MUFASA_SCRATCH_BYTES_MAX (1 << 21)

// One event never makes more actions than this.
#define MUFASA_MAX_ACTIONS 8

// A monitor needs memory aligned to this many bytes, as `malloc` gives it.
#define MUFASA_MONITOR_ALIGN 8

// What a function says about the call itself, not about the data of a cycle. Most are faults of the
// calling program. A station can cause `TableFull` and `InvalidStation`: then its message was ignored, and
// nothing else has changed.
enum MufasaStatus
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  // Done.
  MUFASA_STATUS_OK = 0,
  // A pointer that must not be null is null.
  MUFASA_STATUS_NULL_POINTER = 1,
  // A pointer is not aligned for what it points to.
  MUFASA_STATUS_MISALIGNED = 2,
  // A profile, configuration, group, set of groups or type of an event that does not exist; seconds that are
  // no time.
  MUFASA_STATUS_UNKNOWN_VALUE = 3,
  // The memory is smaller than the function that tells its size says, a number of things that it is
  // to hold is 0, or what was given is longer than that.
  MUFASA_STATUS_MEMORY_TOO_SMALL = 4,
  // A parameter of the requester, or a number of sessions, is below 0, or the latter 2^63 - 1, after which
  // there is no session.
  MUFASA_STATUS_NEGATIVE_PARAMETER = 5,
  // An event names a station below 1.
  MUFASA_STATUS_INVALID_STATION = 6,
  // An offer of a station for which the table has no place.
  MUFASA_STATUS_TABLE_FULL = 7,
  // A parameter of the stages is outside its domain.
  MUFASA_STATUS_INVALID_PARAMETER = 8,
  // The nominal period is not above 0.
  MUFASA_STATUS_INVALID_PERIOD = 9,
  // dt_max is not above the nominal period, so that any jitter would end a session.
  MUFASA_STATUS_DT_MAX_NOT_ABOVE_PERIOD = 10,
  // A value of the route is outside its domain.
  MUFASA_STATUS_INVALID_ROUTE = 11,
  // A time above 0 and below 1 ms, or t_wait above 0 and below 1 s: it is taken for one in another unit
  // than nanoseconds.
  MUFASA_STATUS_TIME_TOO_SHORT = 12,
  // max_age is below l_max, so that no cycle could use some of the results that are in time.
  MUFASA_STATUS_MAX_AGE_BELOW_L_MAX = 13,
  // tau is not above the nominal period, in the hardened profile: the way to stop would end before the next
  // cycle, the first that can fail.
  MUFASA_STATUS_TAU_NOT_ABOVE_PERIOD = 14,
  // A cycle with lists as long as they may become could take longer than check_time.
  MUFASA_STATUS_TOO_SLOW = 15,
  // A setting that no road vehicle has, and that is not named in `meant`.
  MUFASA_STATUS_UNUSUAL = 16,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum MufasaStatus MufasaStatus;
#else
typedef uint32_t MufasaStatus;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// What made a cycle unsafe.
enum MufasaFailedStage
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  // Nothing.
  MUFASA_FAILED_STAGE_NONE = 0,
  // Track validation.
  MUFASA_FAILED_STAGE_I = 1,
  // Trajectory to map.
  MUFASA_FAILED_STAGE_II = 2,
  // Trajectory with tracks.
  MUFASA_FAILED_STAGE_III = 3,
  // Trajectory with detections.
  MUFASA_FAILED_STAGE_IV = 4,
  // Trajectory with grid map.
  MUFASA_FAILED_STAGE_V = 5,
  // Invalid remote data.
  MUFASA_FAILED_STAGE_INPUT = 6,
  // H-05: a trajectory that nothing compared with obstacles.
  MUFASA_FAILED_STAGE_NO_OBSTACLE_CHECK = 7,
  // Invalid local input (`input` says what), or a call that failed.
  MUFASA_FAILED_STAGE_ERROR = 8,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum MufasaFailedStage MufasaFailedStage;
#else
typedef uint32_t MufasaFailedStage;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// What became of a stage.
enum MufasaOutcomeKind
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  // Not part of this configuration.
  MUFASA_OUTCOME_KIND_NOT_SCHEDULED = 0,
  // It ran and found nothing.
  MUFASA_OUTCOME_KIND_PASSED = 1,
  // It found what `witness` says.
  MUFASA_OUTCOME_KIND_FAILED = 2,
  // It did not run, for `reason`.
  MUFASA_OUTCOME_KIND_SKIPPED = 3,
  // It should have run and lacked `missing`.
  MUFASA_OUTCOME_KIND_NOT_APPLICABLE = 4,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum MufasaOutcomeKind MufasaOutcomeKind;
#else
typedef uint32_t MufasaOutcomeKind;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// Why a stage was skipped.
enum MufasaReason
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  // It was not skipped.
  MUFASA_REASON_NONE = 0,
  // An earlier stage failed.
  MUFASA_REASON_AFTER_FAILURE = 1,
  // Another stage made it unnecessary.
  MUFASA_REASON_OTHER_STAGE_RAN = 2,
  // `missing` says which input was not current.
  MUFASA_REASON_NO_CURRENT_INPUT = 3,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum MufasaReason MufasaReason;
#else
typedef uint32_t MufasaReason;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// An input that a stage lacked.
enum MufasaInput
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  // No input was missing.
  MUFASA_INPUT_NONE = 0,
  MUFASA_INPUT_TRAJECTORY = 1,
  MUFASA_INPUT_TRACKS = 2,
  MUFASA_INPUT_DETECTIONS = 3,
  MUFASA_INPUT_GRID = 4,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum MufasaInput MufasaInput;
#else
typedef uint32_t MufasaInput;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// The rule that a witness breaks; the names are those of the answers of `mufasa oracle`.
enum MufasaRule
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  // There is no witness.
  MUFASA_RULE_NONE = 0,
  MUFASA_RULE_AMBIGUOUS = 1,
  MUFASA_RULE_MEAN_COST = 2,
  MUFASA_RULE_WORK_LIMIT = 3,
  MUFASA_RULE_NO_ASSIGNMENT = 4,
  MUFASA_RULE_THETA_MAP = 5,
  MUFASA_RULE_START_TIME = 6,
  MUFASA_RULE_POSITION = 7,
  MUFASA_RULE_START_HEADING = 8,
  MUFASA_RULE_START_OFFSET = 9,
  MUFASA_RULE_CORRIDOR = 10,
  MUFASA_RULE_DIRECTION = 11,
  MUFASA_RULE_STEP_TIME = 12,
  MUFASA_RULE_STEP_LENGTH = 13,
  MUFASA_RULE_STEP_SPEED = 14,
  MUFASA_RULE_STEP_FORWARD = 15,
  MUFASA_RULE_STEP_LATERAL = 16,
  MUFASA_RULE_STEP_TURN = 17,
  MUFASA_RULE_SLIDE = 18,
  MUFASA_RULE_GAP = 25,
  MUFASA_RULE_COLLISION = 26,
  MUFASA_RULE_OCCUPIED = 29,
  MUFASA_RULE_UNKNOWN = 30,
  MUFASA_RULE_OUTSIDE = 31,
  MUFASA_RULE_REACH = 32,
  MUFASA_RULE_FAIL_SAFE = 33,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum MufasaRule MufasaRule;
#else
typedef uint32_t MufasaRule;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// Why a message of a station was dropped; of several reasons the first in this order, except that
// OTHER_SESSION comes before TOO_LONG.
enum MufasaDropReason
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  // It was not dropped, or the call was about no message.
  MUFASA_DROP_REASON_NONE = 0,
  // It has more tracks or points than the settings say. It is no arrival: a station that goes on so is
  // silent, and its session ends after dt_max.
  MUFASA_DROP_REASON_TOO_LONG = 1,
  // It is not of the running session of its group, or there is none.
  MUFASA_DROP_REASON_OTHER_SESSION = 2,
  // It was generated after it arrived: the clocks cannot be trusted. The session has ended.
  MUFASA_DROP_REASON_FROM_THE_FUTURE = 3,
  // Its latency is above l_max. The session has ended.
  MUFASA_DROP_REASON_LATE = 4,
  // Its stamp is more than max_age ago, so that no cycle can use it. It is no arrival.
  MUFASA_DROP_REASON_TOO_OLD = 5,
  // For more than dt_max no cycle has had an element of the session that was current. It is no arrival:
  // the session ends after dt_max.
  MUFASA_DROP_REASON_STARVED = 6,
  // The time since the last arrival is above dt_max. The session has ended.
  MUFASA_DROP_REASON_AFTER_SILENCE = 7,
  // It is not generated later than the last one that was used: repeated, or overtaken.
  MUFASA_DROP_REASON_NOT_NEWER = 8,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum MufasaDropReason MufasaDropReason;
#else
typedef uint32_t MufasaDropReason;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// What the requester does; the comment says which fields of MufasaAction it uses.
enum MufasaActionType
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  // Ask a station to run a group: station, group, session.
  MUFASA_ACTION_TYPE_REQUEST = 1,
  // Tell a station that a session has ended: station, group, session.
  MUFASA_ACTION_TYPE_RELEASE = 2,
  // Start the local services: group.
  MUFASA_ACTION_TYPE_ACTIVATE = 3,
  // Stop the local services: group.
  MUFASA_ACTION_TYPE_DEACTIVATE = 4,
  // Do not use the element that arrived: group.
  MUFASA_ACTION_TYPE_DROP = 5,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum MufasaActionType MufasaActionType;
#else
typedef uint32_t MufasaActionType;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// A group of services; a set of groups is the sum of their numbers.
enum MufasaGroup
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  // MOT: multi-object tracking.
  MUFASA_GROUP_MOT = 1,
  // PLAN: environment model and trajectory planning.
  MUFASA_GROUP_PLAN = 2,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum MufasaGroup MufasaGroup;
#else
typedef uint32_t MufasaGroup;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// What the program around the monitor seems to get wrong, each told once (`spec/4-arithmetic.md#advice`). No verdict
// depends on it: write it to a log that somebody reads.
enum MufasaAdvice
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  // Nothing new.
  MUFASA_ADVICE_NONE = 0,
  // Cycles come in another period than period_ns.
  MUFASA_ADVICE_PERIOD = 1,
  // Detections are given, and none was current.
  MUFASA_ADVICE_DETECTIONS_NOT_CURRENT = 2,
  // A lead is given, and none was current: for the stages nobody is ahead.
  MUFASA_ADVICE_LEAD_NOT_CURRENT = 3,
  // A grid is given, and none was current.
  MUFASA_ADVICE_GRID_NOT_CURRENT = 4,
  // The gap does not change as the speeds of lead and CAV say: km/h, or a speed relative to the CAV.
  MUFASA_ADVICE_LEAD_SPEED = 5,
  // The gap is longer than the way to the detection ahead: between centres, or from the reference point.
  MUFASA_ADVICE_GAP_TOO_LONG = 6,
  // It is shorter: detections that are too small, or a center_offset that is too small.
  MUFASA_ADVICE_GAP_TOO_SHORT = 7,
  // No tick comes: nothing is offloaded, and nobody looks for silence.
  MUFASA_ADVICE_NO_TICK = 8,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum MufasaAdvice MufasaAdvice;
#else
typedef uint32_t MufasaAdvice;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// Why control has to brake.
enum MufasaBrakeReason
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  // It has not to.
  MUFASA_BRAKE_REASON_NONE = 0,
  // The CAV has no current plan of its own.
  MUFASA_BRAKE_REASON_NO_PLAN = 1,
  // Its plan fails, in `failed_stage`, for `witness`.
  MUFASA_BRAKE_REASON_FAILS = 2,
  // The plan, or other local input, is invalid; `input` says what.
  MUFASA_BRAKE_REASON_INVALID = 3,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum MufasaBrakeReason MufasaBrakeReason;
#else
typedef uint32_t MufasaBrakeReason;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// The state of a group.
enum MufasaGroupStateKind
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  // It runs on the CAV.
  MUFASA_GROUP_STATE_KIND_LOCAL = 0,
  // It runs on the CAV, and a station was asked to run it.
  MUFASA_GROUP_STATE_KIND_REQUESTED = 1,
  // It runs on a station.
  MUFASA_GROUP_STATE_KIND_REMOTE = 2,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum MufasaGroupStateKind MufasaGroupStateKind;
#else
typedef uint32_t MufasaGroupStateKind;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// Which groups are remote; `MufasaCycle.configuration` takes its number.
enum MufasaConfiguration
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  // None.
  MUFASA_CONFIGURATION_LOCAL = 1,
  // MOT.
  MUFASA_CONFIGURATION_MOT_REMOTE = 2,
  // MOT and PLAN.
  MUFASA_CONFIGURATION_ALL_REMOTE = 3,
  // PLAN.
  MUFASA_CONFIGURATION_PLAN_REMOTE = 4,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum MufasaConfiguration MufasaConfiguration;
#else
typedef uint32_t MufasaConfiguration;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// A profile; `MufasaMonitorSettings.profile` and `MufasaCycle.profile` take its number.
enum MufasaProfile
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  // The published method.
  MUFASA_PROFILE_PAPER = 1,
  // The published method and the rules H-nn.
  MUFASA_PROFILE_HARDENED = 2,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum MufasaProfile MufasaProfile;
#else
typedef uint32_t MufasaProfile;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// What happens; the comment says which further fields of MufasaEvent it uses.
enum MufasaEventType
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  // A station offers groups: station, groups.
  MUFASA_EVENT_TYPE_OFFER = 1,
  // A station withdraws its offer: station.
  MUFASA_EVENT_TYPE_WITHDRAW = 2,
  // A station can no longer be reached: station.
  MUFASA_EVENT_TYPE_LOST = 3,
  // These groups may be offloaded here: groups.
  MUFASA_EVENT_TYPE_AREA = 4,
  // Time passes.
  MUFASA_EVENT_TYPE_TICK = 5,
  // A station confirms: station, group, session.
  MUFASA_EVENT_TYPE_CONFIRM = 6,
  // A station rejects: station, group, session.
  MUFASA_EVENT_TYPE_REJECT = 7,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum MufasaEventType MufasaEventType;
#else
typedef uint32_t MufasaEventType;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// A monitor in the memory of the caller; its content may change from version to version.
typedef struct MufasaMonitor MufasaMonitor;

// A point in time on the CAV's one monotonic clock, that of the remote's stamps after conversion, too. A type
// of its own, so that microseconds are not taken for nanoseconds: make it with `mufasa_time_from_...`. A bare
// number assigned, given as an argument or in an initialiser (`{50}`) does not compile.
typedef struct MufasaTime {
  union {
    const struct MufasaBareNumber *no_bare_number;
  // Nanoseconds after the clock's start.
  int64_t ns;
  };
} MufasaTime;

// A distance between two vehicles, from bumper to bumper: make it with `mufasa_gap_between_bumpers`. A bare
// number assigned or given as an argument is an error; in an initialiser without inner braces it is none, unless you
// compile with `-Werror=missing-braces`.
typedef struct MufasaGap {
  // m, from the front edge of the CAV's rectangle to the nearest point of the leading vehicle, along
  // the reference path.
  double between_bumpers;
} MufasaGap;

// Parameters; names, defaults and domains as in spec/.
typedef struct MufasaParameters {
  // Stage i: the mean distance of the assigned pairs has to be below this, m.
  // Default: 0.2
  double theta_tr;
  // Stage ii: farthest a point outside the corridor may be from the reference path, m.
  // Default: 0.3
  double theta_map;
  // Stages iii and iv: objects nearer than this are examined, m.
  // Default: 5.0
  double theta_obj;
  // Braking deceleration, m/s^2.
  // Default: 8.0
  double a_b;
  // Time of the safety distance required by law, s.
  // Default: 1.8
  double safety_time;
  // Oldest age at which data count as current, ns; what is later than now is not current either.
  // Default: 100_000_000
  int64_t max_age_ns;
  // Stage v: disks that cover the footprint.
  // Default: 4
  int64_t n;
  // H-01: every assigned pair has to be closer than this, m.
  // Default: 1.0
  double theta_track_max;
  // H-01: gated tracks that may stay without a detection.
  // Default: 4
  int64_t miss_budget;
  // H-14: the longest time from measuring pose and speed to braking, s.
  // Default: 0.1
  double tau;
  // H-14: greatest acceleration of the CAV, m/s^2.
  // Default: 3.0
  double a_max;
  // H-07: how much farther from the CAV than it can drive a point may be, m.
  // Default: 2.0
  double start_tolerance;
  // H-11: greatest speed of a trajectory, m/s.
  // Default: 150.0
  double v_max;
  // H-11: longest time between two trajectory points, ns.
  // Default: 200_000_000
  int64_t step_max_ns;
  // Greatest error of the velocity of a track, m/s.
  // Default: 2.0
  double theta_velocity;
  // H-07, H-14: how far aside a trajectory may pass the CAV, and its greatest excess, m.
  // Default: 0.5
  double lateral_tolerance;
  // H-14: the greatest speed of an object that is looked for, m/s.
  // Default: 70.0
  double v_object;
  // H-14: how long after the CAV others begin to brake for it, s.
  // Default: 2.0
  double t_yield;
  // H-14: how hard they brake then, m/s^2.
  // Default: 3.0
  double a_yield;
  // Stage i fails rather than begin an assignment of more steps than this, H-14 once it has taken more.
  // Default: 700_000
  int64_t work_limit;
  // Margin of the strict and the lax model, m; no verdict of this crate depends on it.
  // Default: 1e-6
  double delta;
} MufasaParameters;

// Pose, speed and size of the CAV, in the right-handed frame of the cycle, which stands still. x, y is its reference
// point (the rear axle, or up to length/2 ahead of it), and the centre of its rectangle is `center_offset` ahead of that.
// (cos, sin) is the direction that it heads in, as an angle from x towards y.
typedef struct MufasaEgo {
  // Place of the reference point, m.
  double x;
  // Place of the reference point, m.
  double y;
  // cos of the direction.
  double cos;
  // sin of the direction.
  double sin;
  // Not below 0, m/s.
  double speed;
  // Of the rectangle, along the direction, m.
  double length;
  // Of the rectangle, across, m.
  double width;
  // From the reference point forward to the centre of the rectangle (negative: back), m.
  double center_offset;
} MufasaEgo;

// One cross section of a route, in the right-handed frame of the cycle, which stands still. x, y is its point of the
// reference path; the left boundary is to the left of the driving direction (cos, sin), on the side of (-sin, cos).
typedef struct MufasaCrossSection {
  // Point of the reference path, m.
  double x;
  // Point of the reference path, m.
  double y;
  // x and y of the left boundary, m.
  double left[2];
  // x and y of the right boundary, m.
  double right[2];
} MufasaCrossSection;

// Reference path and boundaries.
typedef struct MufasaRoute {
  // Not 0: the last cross section is followed by the first.
  uint8_t closed;
  // Cross sections in driving order.
  const struct MufasaCrossSection *cross_sections;
  // How many.
  size_t cross_sections_len;
} MufasaRoute;

// One pose of a trajectory: x, y is the place of the CAV's reference point (that of MufasaEgo, not the centre of its
// rectangle), (cos, sin) the direction that it heads in, in the right-handed frame of the cycle, which stands still.
typedef struct MufasaTrajectoryPoint {
  // When the CAV is to be there.
  struct MufasaTime t;
  // Place of the reference point, m.
  double x;
  // Place of the reference point, m.
  double y;
  // cos of the direction.
  double cos;
  // sin of the direction.
  double sin;
} MufasaTrajectoryPoint;

// The planned trajectory. Points are places of the CAV's reference point (that of MufasaEgo), in the right-handed frame of
// the cycle, which stands still.
//
// In the hardened profile stage ii asks of the points, over their whole length:
// * start: the first within `max_age_ns` of now, at most `lateral_tolerance` aside, heading as the CAV to about 10
//   degrees (H-07);
// * position: none farther from the CAV's reference point than the CAV can drive by its time, speeding up by
//   `a_max`, and `start_tolerance` (H-07);
// * steps: at most `step_max_ns`, L and `v_max` dt from point to point, forwards along both headings, which
//   turn as a vehicle can (H-11);
// * reach: the path from the CAV through those that are ahead of it, and straight on, beyond what the CAV can
//   drive by at most `lateral_tolerance` (H-14). Behind its last point, and whatever its times say, the CAV has to be able to
//   go on and stop;
// * corridor: every point inside, none heading against the route (H-07), and each place of that path inside, up to
//   where the CAV stands at the latest (H-14).
typedef struct MufasaTrajectory {
  // Time of generation.
  struct MufasaTime stamp;
  // Points in order of time.
  const struct MufasaTrajectoryPoint *points;
  // How many.
  size_t points_len;
} MufasaTrajectory;

// A tracked object, in the right-handed frame of the cycle, which stands still (not relative to the CAV). x, y is the
// centre of its rectangle, (cos, sin) its direction; its velocity is over ground in the same frame.
typedef struct MufasaTrack {
  // Identity over time.
  int64_t id;
  // Centre of the rectangle, m.
  double x;
  // Centre of the rectangle, m.
  double y;
  // cos of the direction.
  double cos;
  // sin of the direction.
  double sin;
  // Velocity along the frame's x, m/s.
  double vx;
  // Velocity along the frame's y, m/s.
  double vy;
  // Of the rectangle, along the direction, m.
  double length;
  // Of the rectangle, across, m.
  double width;
} MufasaTrack;

// A list of tracks.
typedef struct MufasaTrackList {
  // Time that the positions are valid for.
  struct MufasaTime stamp;
  // Tracks in list order.
  const struct MufasaTrack *items;
  // How many.
  size_t items_len;
} MufasaTrackList;

// A detected object, in the right-handed frame of the cycle, which stands still (not relative to the CAV). x, y is the
// centre of its rectangle, (cos, sin) its direction.
typedef struct MufasaDetection {
  // Centre of the rectangle, m.
  double x;
  // Centre of the rectangle, m.
  double y;
  // cos of the direction.
  double cos;
  // sin of the direction.
  double sin;
  // Of the rectangle, along the direction, m.
  double length;
  // Of the rectangle, across, m.
  double width;
} MufasaDetection;

// The detections of all local detectors.
typedef struct MufasaDetectionList {
  // Time of measurement.
  struct MufasaTime stamp;
  // Detections in list order.
  const struct MufasaDetection *items;
  // How many.
  size_t items_len;
} MufasaDetectionList;

// The leading vehicle: its free distance and speed along the reference path, the former bumper to bumper.
typedef struct MufasaLead {
  // Time of measurement.
  struct MufasaTime stamp;
  // From bumper to bumper, in metres.
  struct MufasaGap gap;
  // Speed of the leading vehicle over ground along the reference path at the time of measurement, not below 0, m/s.
  double speed;
} MufasaLead;

// An occupancy grid map. x, y is its origin, a corner (not the centre), in the right-handed frame of the cycle, which
// stands still; columns count from there in the direction (cos, sin), rows in (-sin, cos), to the left of it. The cell of
// column i and row k is the square from (i, k) to (i + 1, k + 1) times `resolution`.
typedef struct MufasaGrid {
  // Time of measurement.
  struct MufasaTime stamp;
  // The origin, m.
  double x;
  // The origin, m.
  double y;
  // cos of the direction.
  double cos;
  // sin of the direction.
  double sin;
  // Side of a cell, m.
  double resolution;
  // Columns.
  int64_t width;
  // Rows.
  int64_t height;
  // Bit row * width + column, least significant bit of each byte first; 1 is occupied.
  const uint8_t *occupied;
  // Bytes of `occupied`: (width * height + 7) / 8.
  size_t occupied_len;
  // The same form, 1 is unknown, or null; a cell both occupied and unknown is occupied.
  const uint8_t *unknown;
  // Bytes of `unknown`.
  size_t unknown_len;
} MufasaGrid;

// One cycle. A null pointer is a missing input.
//
// All places are in one right-handed frame of the road plane that stands still (UTM, or any other); lengths in m,
// speeds in m/s. A direction (cos, sin) is that of an angle from x towards y; to the left of it is (-sin, cos). Times
// are of the CAV's monotonic clock.
typedef struct MufasaCycle {
  // A MufasaProfile.
  uint32_t profile;
  // A MufasaConfiguration.
  uint32_t configuration;
  // The time that pose and speed of the CAV are of, on its monotonic clock: carry older ones forward to it (H-14.14).
  struct MufasaTime now;
  // Start from `mufasa_parameters_default`.
  struct MufasaParameters parameters;
  // The CAV itself.
  struct MufasaEgo ego;
  // The route.
  struct MufasaRoute route;
  // May be null.
  const struct MufasaTrajectory *trajectory;
  // May be null.
  const struct MufasaTrackList *tracks;
  // May be null.
  const struct MufasaDetectionList *detections;
  // May be null.
  const struct MufasaLead *lead;
  // May be null.
  const struct MufasaGrid *grid;
  // Earlier lists of the CAV's own detections, the youngest first (stamps strictly decreasing), at
  // most 4. May be null when there is none. Keep every list that was `detections` for a second.
  // Used are those that are 200 ms to 1 s older than `detections`: give the lists whose ages are
  // nearest to 300, 500 and 800 ms, the one nearest to 500 ms being the reference. A cycle that was
  // not safe leaves its detections in the history like any other; older than 60 s, a list counts
  // as missing. With fewer than two of these no track is backed: none may miss its detection (H-01),
  // and no detection is explained, so that each counts as standing, too; with none of them only
  // tracks are looked at as moving (H-14). The verdict is then valid, but rejects more and knows less.
  const struct MufasaDetectionList *detection_history;
  // How many.
  size_t detection_history_len;
} MufasaCycle;

// Why a stage failed. Indices that mean nothing for the rule are -1.
typedef struct MufasaWitness {
  // The rule that was broken.
  MufasaRule rule;
  // 1 when `track` means something.
  uint32_t has_track;
  // Id of the track.
  int64_t track;
  // Index of the trajectory point (the later one of a step); places behind the last count on.
  int64_t point;
  // Index of the detection.
  int64_t detection;
  // Index of the item in a list of the detection history.
  int64_t item;
  // Age of that list, ns.
  int64_t age_ns;
  // Index of the segment of the reference path.
  int64_t segment;
  // Index of the disk.
  int64_t disk;
  // Column and row of the grid cell.
  int64_t cell[2];
  // The two numbers that were compared.
  double compared[2];
} MufasaWitness;

// What became of one stage.
typedef struct MufasaOutcome {
  // What became of it.
  MufasaOutcomeKind kind;
  // Of a skipped stage.
  MufasaReason reason;
  // Of a stage that lacked an input.
  MufasaInput missing;
  // Of a failed stage.
  struct MufasaWitness witness;
} MufasaOutcome;

// What is wrong with the input. The texts are empty when nothing is.
typedef struct MufasaInvalidInput {
  // Dotted path of the field, such as tracks.items.vx.
  char field[MUFASA_TEXT_BYTES];
  // What is wrong and what would be right.
  char message[MUFASA_TEXT_BYTES];
  // Index in the innermost list, or -1.
  int64_t index;
} MufasaInvalidInput;

// The answer to one cycle.
typedef struct MufasaReport {
  // 1 when the cycle is safe, else 0: `if (report.safe)`.
  uint32_t safe;
  // What made the cycle unsafe; NONE of a safe one.
  MufasaFailedStage failed_stage;
  // Stages i to v.
  struct MufasaOutcome stages[5];
  // The problem of invalid input, local or remote.
  struct MufasaInvalidInput input;
} MufasaReport;

// Parameters; names, defaults and domains as in spec/.
typedef struct MufasaRequesterParameters {
  // How long offloading is barred after a safety issue, ns.
  // Default: 10_000_000_000
  int64_t t_wait_ns;
  // How long a request waits for its confirmation, ns.
  // Default: 500_000_000
  int64_t request_timeout_ns;
  // Largest latency that is no violation, ns.
  // Default: 50_000_000
  int64_t l_max_ns;
  // Largest inter-arrival time that is no violation, ns.
  // Default: 100_000_000
  int64_t dt_max_ns;
  // Whether a violation of quality of service starts a hold, too (I-09).
  // Default: false
  uint32_t qos_hold;
} MufasaRequesterParameters;

// What a monitor is made with. The last five fields say how much memory it needs; what is longer is
// refused when it comes.
typedef struct MufasaMonitorSettings {
  // A MufasaProfile.
  uint32_t profile;
  // Parameters of the stages.
  struct MufasaParameters stages;
  // Times of the requester.
  struct MufasaRequesterParameters requester;
  // The nominal period of the cycles and of the remote's results in nanoseconds, at least 1,000,000 (1 ms).
  // `requester.dt_max_ns` has to be above it: at equality one nanosecond of jitter ends the session. The default,
  // two periods and 20 ms of jitter, bears one lost message. In the hardened profile `stages.tau`, in seconds, has to be at least 2.5 of it, unless less is meant.
  int64_t period_ns;
  // At least the last session of the monitor's earlier lives; 0 for a first life, at most 2^63 - 2. Sessions are
  // numbered on from here, so that no message of an earlier life fits.
  int64_t sessions_before;
  // How long a cycle may take, ns: what may take longer is refused; INT64_MAX for any time.
  int64_t check_time_ns;
  // What a step costs on this processor, ps: see `mufasa_monitor_calibrate`.
  uint64_t step_ps;
  // Sum of `mufasa_monitor_meant`: settings that are meant although no road vehicle has such; UINT32_MAX for all.
  uint32_t meant;
  // 1: while all groups are local `brake` of a decision says whether control has to brake instead of following the
  // plan of the CAV's own. Lists may then take half the steps. Else 0: nobody examines that plan.
  uint32_t supervise_local;
  // How far the CAV gets, m, at least 0, in the time below; else PLAN is given back.
  double stall_way_m;
  // For how long PLAN is remote meanwhile, ns, at least 1 s; 0: PLAN is never given back for this reason.
  int64_t stall_time_ns;
  // Stations that ever offer something, at least 1.
  size_t most_stations;
  // Tracks of a list, at least 1.
  size_t most_tracks;
  // Points of a trajectory.
  size_t most_points;
  // Detections of a list, at least 1 in the hardened profile.
  size_t most_detections;
  // Cross sections of a route.
  size_t most_cross_sections;
} MufasaMonitorSettings;

// Something that happens at a time. Fields that its type does not use may be anything.
typedef struct MufasaEvent {
  // The CAV's monotonic clock.
  struct MufasaTime t;
  // A MufasaEventType.
  uint32_t event_type;
  // A MufasaGroup.
  uint32_t group;
  // Sum of MufasaGroup.
  uint32_t groups;
  // Id of the station, at least 1.
  int64_t station;
  // The session that the message names.
  int64_t session;
} MufasaEvent;

// Something to be done.
typedef struct MufasaAction {
  // What.
  MufasaActionType action_type;
  // Which group.
  MufasaGroup group;
  // Id of the station, or 0.
  int64_t station;
  // The session, or 0.
  int64_t session;
} MufasaAction;

// What has to be done about an event, in this order.
typedef struct MufasaActions {
  // Why the message of this call is of no use, where it is; then a DROP is among the actions.
  MufasaDropReason dropped;
  // How many; of the array the rest means nothing.
  size_t len;
  // The actions.
  struct MufasaAction items[MUFASA_MAX_ACTIONS];
} MufasaActions;

// A message of a station with tracks.
typedef struct MufasaTrackMessage {
  // Id of the station, at least 1.
  int64_t station;
  // The session that it names.
  int64_t session;
  // When the station made it, on the CAV's clock.
  struct MufasaTime generated;
  // The tracks; they are copied.
  struct MufasaTrackList tracks;
} MufasaTrackMessage;

// A message of a station with a trajectory.
typedef struct MufasaTrajectoryMessage {
  // Id of the station, at least 1.
  int64_t station;
  // The session that it names.
  int64_t session;
  // When the station made it, on the CAV's clock.
  struct MufasaTime generated;
  // The trajectory; it is copied.
  struct MufasaTrajectory trajectory;
} MufasaTrajectoryMessage;

// What the CAV knows when a cycle begins. Profile, parameters, configuration, route, the station's data and
// earlier detections are not among it: the monitor has them.
//
// All places, those of the route and of stations' messages, too, are in one right-handed frame of the road plane that
// stands still (UTM, or any other); lengths in m, speeds in m/s. A direction (cos, sin) is that of an angle from x towards
// y; to the left of it is (-sin, cos). Times are of the CAV's monotonic clock.
typedef struct MufasaMonitorInputs {
  // The CAV.
  struct MufasaEgo ego;
  // The detections of all local detectors, of which the monitor keeps a copy; may be null.
  const struct MufasaDetectionList *detections;
  // The leading vehicle, its gap bumper to bumper; may be null.
  const struct MufasaLead *lead;
  // The occupancy grid map; may be null.
  const struct MufasaGrid *grid;
  // Tracks of the CAV's own MOT, used while MOT is not remote; may be null.
  const struct MufasaTrackList *local_tracks;
  // The trajectory of the CAV's own planner, used while PLAN is not remote; may be null.
  const struct MufasaTrajectory *local_trajectory;
} MufasaMonitorInputs;

// Whether control has to brake with at least `a_b`, from this cycle on until one says nothing of the kind, instead of
// following a plan of the CAV's own. Only with `supervise_local`.
typedef struct MufasaBrake {
  // Whether, and why: `if (decision.brake.reason)`.
  MufasaBrakeReason reason;
  // Of a plan that fails.
  MufasaFailedStage failed_stage;
  // Of a plan that fails; none where nothing compared it with obstacles (H-05).
  struct MufasaWitness witness;
  // Of invalid input.
  struct MufasaInvalidInput input;
} MufasaBrake;

// The end of a cycle. Remote data come out here alone, in memory of the monitor, and may be read until
// its next call, which empties the lists.
typedef struct MufasaDecision {
  // Whether it is safe, and why not; the requester has been told. Anything but safe has made every group
  // local.
  struct MufasaReport report;
  // Of a safe cycle the tracks of the station, while MOT is remote, they are current, and stage i ran: they were
  // compared with what the CAV sees; an object that is not among them may still exist. Else null, so while the CAV
  // has no current detections, too.
  const struct MufasaTrackList *tracks;
  // Of a safe cycle the trajectory that was checked, while a group is remote, it is current and, in the hardened
  // profile, the CAV has current detections: that of the station, or while MOT alone is remote that of the CAV's own
  // planner; else null.
  const struct MufasaTrajectory *trajectory;
  // By when control has to brake along the trajectory, with at least `a_b`, unless a later cycle has given one or, at
  // a cycle in LOCAL, there is a plan of the CAV's own: what was examined covers no more. INT64_MAX ns where there is no trajectory, and in
  // the paper profile.
  struct MufasaTime brake_by;
  // Releases to be sent, and local services that start or stop.
  struct MufasaActions actions;
  // Sum of MufasaGroup: the groups whose local services have to run from now on. Who sets his services to
  // it in each period has started them even when he lost an action.
  uint32_t local_services;
  // What this program seems to get wrong, if there is something new; `mufasa_advice_text` says it in words.
  MufasaAdvice advice;
  // Of the CAV's own plan.
  struct MufasaBrake brake;
} MufasaDecision;

// The state of a group.
typedef struct MufasaGroupState {
  // What it is.
  MufasaGroupStateKind kind;
  // The station, or 0.
  int64_t station;
  // The session, or 0.
  int64_t session;
  // Of a requested group: a confirmation must come before this time.
  struct MufasaTime deadline;
  // The station whose results may reach control; 0 is the CAV.
  int64_t source;
} MufasaGroupState;

// The state of a requester.
typedef struct MufasaRequesterState {
  // MOT.
  struct MufasaGroupState mot;
  // PLAN.
  struct MufasaGroupState plan;
  // Which groups are remote.
  MufasaConfiguration configuration;
  // 0: there never was a hold.
  uint32_t has_hold;
  // No request is sent before this time.
  struct MufasaTime hold_until;
} MufasaRequesterState;

// What is wrong with settings. The texts are empty when nothing is.
typedef struct MufasaSettingsProblem {
  // Dotted path of the field; `parameters.x` names the field `x` of `stages`.
  char field[MUFASA_TEXT_BYTES];
  // What is wrong and what would be right.
  char message[MUFASA_TEXT_BYTES];
  // What was given, in the unit of the field (the period of UNUSUAL: s), or NAN where the message says it.
  double value;
  // The limit below while the other fields are as they are, or NAN.
  double least;
  // The limit above, or NAN.
  double most;
} MufasaSettingsProblem;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// The version of the library: 1000000 times the first number, 1000 times the second, and the third. Header
// and library belong together only when these are those of the header.
uint32_t mufasa_version(void);

// So many nanoseconds after the clock's start.
MUFASA_MUST_USE struct MufasaTime mufasa_time_from_nanoseconds(int64_t nanoseconds);

// So many microseconds after the clock's start; beyond 2^63 ns (292 years) the earliest time, of which
// nothing is current.
MUFASA_MUST_USE
struct MufasaTime mufasa_time_from_microseconds(int64_t microseconds);

// As `mufasa_time_from_microseconds`, of milliseconds.
MUFASA_MUST_USE struct MufasaTime mufasa_time_from_milliseconds(int64_t milliseconds);

// Writes the time so many seconds after the clock's start, to about the nearest nanosecond (doubles are coarser
// than that from 104 days on). UNKNOWN_VALUE: no number, or beyond 2^63 ns; then the earliest time is written.
//
// # Safety
// `time` is null or can be written to.
MUFASA_MUST_USE
MufasaStatus mufasa_time_from_seconds(double seconds,
                                      struct MufasaTime *time);

// So many metres from bumper to bumper.
MUFASA_MUST_USE struct MufasaGap mufasa_gap_between_bumpers(double metres);

// The defaults of spec/3-stages.md.
struct MufasaParameters mufasa_parameters_default(void);

// Bytes of scratch memory that `mufasa_check` needs for this cycle, at any alignment;
// MUFASA_SCRATCH_BYTES_MAX when the cycle cannot be read.
//
// # Safety
// Every pointer in the cycle is null or points to what its type says.
size_t mufasa_scratch_bytes(const struct MufasaCycle *cycle);

// Decides one cycle. Unless `report` is null or misaligned it is always written; when the status
// is not OK it is not safe. Use data of a cycle only when it is safe. No requester is told of it, so
// that nothing falls back: a vehicle calls `mufasa_monitor_cycle`.
//
// # Safety
// Every pointer in the cycle is null or points to what its type says, in the number that is
// given beside it, which nobody writes to during the call. `scratch` points to `scratch_bytes`
// bytes that nobody else uses during the call and that overlap nothing in the cycle and not the
// report; their content means nothing before and after.
MUFASA_MUST_USE
MufasaStatus mufasa_check(const struct MufasaCycle *cycle,
                          void *scratch,
                          size_t scratch_bytes,
                          struct MufasaReport *report);

// The hardened profile, a `tau` of three periods and 0.1 s, a `dt_max` of two periods and 20 ms, and else the paper's values in a first life, for 8 stations, 128 tracks, 128 points,
// 256 detections and 528 cross sections.
struct MufasaMonitorSettings mufasa_monitor_settings_default(int64_t period_ns);

// What a step costs on this processor, ps: `step_ps`. It times work by a monotonic clock in ns that tells microseconds apart, which is
// called with `context`. Take the greatest of several answers. 0 where `now_ns` is null.
uint64_t mufasa_monitor_calibrate(uint64_t (*now_ns)(void *context),
                                  void *context);

// What `meant` has of a setting, such as "stages.a_b"; 0 of a name that there is not.
//
// # Safety
// `field` is null or points to a text that ends with 0.
MUFASA_MUST_USE uint32_t mufasa_monitor_meant(const char *field);

// Bytes of memory for a monitor with these settings; SIZE_MAX when they cannot be read.
//
// # Safety
// `settings` is null or points to settings.
size_t mufasa_monitor_bytes(const struct MufasaMonitorSettings *settings);

// Makes a monitor in `memory`, whose content means nothing before: everything local, no offers, no
// route, nothing seen yet. `*monitor` is where it is; it needs no end, and may not be moved. When the
// status is not OK there is none, and `*monitor`, if it can be written to, is null;
// `mufasa_monitor_settings_problem` says the field that is wrong.
//
// # Safety
// `settings` is null or points to settings; `memory` points to `bytes` bytes that nobody else uses as
// long as the monitor is used; `monitor` is null or can be written to.
MUFASA_MUST_USE
MufasaStatus mufasa_monitor_init(const struct MufasaMonitorSettings *settings,
                                 void *memory,
                                 size_t bytes,
                                 struct MufasaMonitor **monitor);

// From now on the CAV follows this route, of which a copy and an index are kept. When the status is
// not OK it follows the route before; INVALID_ROUTE: a value is outside its domain, of which
// `mufasa_monitor_route_problem` says the field. Where the route ends before the CAV can stop, each cycle of the
// hardened profile fails stage ii (H-14.58).
//
// # Safety
// `monitor` is null or comes from `mufasa_monitor_init`, in memory that nobody else wrote to, and no other
// call uses it at the same time; `route` is null or points to a route with as many cross sections as
// it says.
MUFASA_MUST_USE
MufasaStatus mufasa_monitor_set_route(struct MufasaMonitor *monitor,
                                      const struct MufasaRoute *route);

// Takes an event and writes what has to be done about it. DATA and VERDICT are UNKNOWN_VALUE here: data
// come with their contents (`mufasa_monitor_tracks`, `mufasa_monitor_trajectory`), and the verdict is
// `mufasa_monitor_cycle`'s. When the status is not OK nothing has changed, and there are no actions.
// TICK is to be given in each period, before its cycle.
//
// # Safety
// `monitor` as for `mufasa_monitor_set_route`; `event` is null or points to an event; `actions` is null
// or can be written to.
MUFASA_MUST_USE
MufasaStatus mufasa_monitor_step(struct MufasaMonitor *monitor,
                                 const struct MufasaEvent *event,
                                 struct MufasaActions *actions);

// Tracks of a station arrive: used are those of the running session of MOT, in time, and newer than the
// last. They are copied, and come out of the next cycle if it is safe. When one of `actions` is DROP they
// are of no use, and `actions->dropped` says why, more tracks than the settings say among it; a violation
// of quality of service ends the session, too. For every status but OK nothing has changed.
//
// # Safety
// `monitor` as for `mufasa_monitor_set_route`; `message` is null or points to a message with as many
// tracks as it says; `actions` is null or can be written to.
MUFASA_MUST_USE
MufasaStatus mufasa_monitor_tracks(struct MufasaMonitor *monitor,
                                   struct MufasaTime now,
                                   const struct MufasaTrackMessage *message,
                                   struct MufasaActions *actions);

// As `mufasa_monitor_tracks`, for a trajectory of a station and PLAN. What its points have to be like
// stands at MufasaTrajectory.
//
// # Safety
// As for `mufasa_monitor_tracks`.
MUFASA_MUST_USE
MufasaStatus mufasa_monitor_trajectory(struct MufasaMonitor *monitor,
                                       struct MufasaTime now,
                                       const struct MufasaTrajectoryMessage *message,
                                       struct MufasaActions *actions);

// Decides on the inputs and the last elements that were used, and tells the requester: to be called in
// each period, offloading or not. Unless `decision` is null or misaligned it is always written; when
// the status is not OK (a pointer in the inputs that cannot be followed, a list longer than the settings
// say) it is not safe, and every group is local as after any other unsafe cycle. Where `decision`
// itself is null or misaligned, or `monitor` is, nothing has happened.
//
// # Safety
// `monitor` as for `mufasa_monitor_set_route`; `inputs` is null or points to inputs, every pointer in which
// is null or points to what its type says, in the number that is given beside it, which nobody writes to
// during the call; `decision` is null or can be written to.
MUFASA_MUST_USE
MufasaStatus mufasa_monitor_cycle(struct MufasaMonitor *monitor,
                                  struct MufasaTime now,
                                  const struct MufasaMonitorInputs *inputs,
                                  struct MufasaDecision *decision);

// Writes the state of the monitor's requester.
//
// # Safety
// `monitor` as for `mufasa_monitor_set_route`; `state` is null or can be written to.
MUFASA_MUST_USE
MufasaStatus mufasa_monitor_state(const struct MufasaMonitor *monitor,
                                  struct MufasaRequesterState *state);

// When PLAN was given back last because the CAV got nowhere (`stall_time_ns`), at a tick that names its release;
// INT64_MIN ns: never, or the monitor is null.
//
// # Safety
// `monitor` as for `mufasa_monitor_set_route`.
MUFASA_MUST_USE
struct MufasaTime mufasa_monitor_given_back(const struct MufasaMonitor *monitor);

// What `mufasa_monitor_init` says of these settings, whatever the memory, and writes which field is wrong
// and what would be right; empty texts when none is.
//
// # Safety
// `settings` is null or points to settings; `problem` is null or can be written to.
MUFASA_MUST_USE
MufasaStatus mufasa_monitor_settings_problem(const struct MufasaMonitorSettings *settings,
                                             struct MufasaSettingsProblem *problem);

// Writes which field of the route made the last call of `mufasa_monitor_set_route` fail; empty texts when
// it did not, or when a pointer or a length was wrong.
//
// # Safety
// `monitor` as for `mufasa_monitor_set_route`; `problem` is null or can be written to.
MUFASA_MUST_USE
MufasaStatus mufasa_monitor_route_problem(const struct MufasaMonitor *monitor,
                                          struct MufasaInvalidInput *problem);

// A MufasaStatus in words, which live as long as the program.
MUFASA_MUST_USE const char *mufasa_status_text(uint32_t status);

// A MufasaDropReason in words.
MUFASA_MUST_USE const char *mufasa_drop_reason_text(uint32_t reason);

// A MufasaActionType in words.
MUFASA_MUST_USE const char *mufasa_action_text(uint32_t action_type);

// A MufasaAdvice in words.
MUFASA_MUST_USE const char *mufasa_advice_text(uint32_t advice);

// A MufasaFailedStage in words.
MUFASA_MUST_USE const char *mufasa_failed_stage_text(uint32_t failed_stage);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* MUFASA_H */
