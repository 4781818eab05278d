/* What a check promises, from C: verdicts, and errors of the call. */
#include <stdlib.h>
#include <string.h>

#include "expect.h"
#include "mufasa.h"

#define SECOND INT64_C(1000000000)
#define AT(ns) mufasa_time_from_nanoseconds(ns)

/* A straight road, a car 30 m ahead that track and detection agree on, a trajectory that begins
 * here. Everything points into this. */
struct scene {
  struct MufasaTrajectoryPoint points[2];
  struct MufasaTrack track_items[1];
  struct MufasaDetection detection_items[1];
  struct MufasaCrossSection cross_sections[2];
  struct MufasaTrajectory trajectory;
  struct MufasaTrackList tracks;
  struct MufasaDetectionList detections;
  struct MufasaLead lead;
  struct MufasaGrid grid;
  uint8_t bitmap[8];
  struct MufasaCycle cycle;
};

static void set_up(struct scene *s) {
  memset(s, 0, sizeof *s);
  s->points[0] = (struct MufasaTrajectoryPoint){AT(SECOND), 0, 0, 1, 0};
  s->points[1] = (struct MufasaTrajectoryPoint){AT(SECOND + SECOND / 10), 1, 0, 1, 0};
  s->track_items[0] = (struct MufasaTrack){7, 30, 0, 1, 0, 10, 0, 4.5, 1.8};
  s->detection_items[0] = (struct MufasaDetection){30, 0.1, 1, 0, 4.5, 1.8};
  s->cross_sections[0] = (struct MufasaCrossSection){0, 0, {0, 2}, {0, -2}};
  s->cross_sections[1] = (struct MufasaCrossSection){100, 0, {100, 2}, {100, -2}};
  s->trajectory = (struct MufasaTrajectory){AT(SECOND), s->points, 2};
  s->tracks = (struct MufasaTrackList){AT(SECOND), s->track_items, 1};
  s->detections = (struct MufasaDetectionList){AT(SECOND), s->detection_items, 1};
  s->lead = (struct MufasaLead){AT(SECOND), mufasa_gap_between_bumpers(25), 10};
  s->grid = (struct MufasaGrid){AT(SECOND), 0, -4, 1, 0, 1.0, 8, 8, s->bitmap, 8, NULL, 0};
  s->cycle.profile = MUFASA_PROFILE_PAPER;
  s->cycle.configuration = MUFASA_CONFIGURATION_ALL_REMOTE;
  s->cycle.now = AT(SECOND);
  s->cycle.parameters = mufasa_parameters_default();
  s->cycle.ego = (struct MufasaEgo){0, 0, 1, 0, 13.9, 4.8, 1.9, 1.4};
  s->cycle.route = (struct MufasaRoute){0, s->cross_sections, 2};
  s->cycle.trajectory = &s->trajectory;
  s->cycle.tracks = &s->tracks;
  s->cycle.detections = &s->detections;
  s->cycle.lead = &s->lead;
  s->cycle.grid = &s->grid;
}

static char scratch[MUFASA_SCRATCH_BYTES_MAX];

static struct MufasaReport checked(const struct MufasaCycle *cycle) {
  struct MufasaReport report;
  memset(&report, 0xff, sizeof report);
  EXPECT(mufasa_check(cycle, scratch, sizeof scratch, &report) == MUFASA_STATUS_OK);
  return report;
}

static void verdicts(void) {
  struct scene s;
  set_up(&s);
  struct MufasaReport report = checked(&s.cycle);
  EXPECT(report.safe);
  EXPECT(report.failed_stage == MUFASA_FAILED_STAGE_NONE);
  EXPECT(report.stages[0].kind == MUFASA_OUTCOME_KIND_PASSED);
  EXPECT(report.stages[3].kind == MUFASA_OUTCOME_KIND_SKIPPED);
  EXPECT(report.stages[3].reason == MUFASA_REASON_OTHER_STAGE_RAN);
  EXPECT(report.input.field[0] == 0 && report.input.index == -1);

  /* A track 1 m beside what was detected: stage i. */
  s.track_items[0].y = 1.1;
  s.track_items[0].x = 29;
  report = checked(&s.cycle);
  EXPECT(!report.safe);
  EXPECT(report.failed_stage == MUFASA_FAILED_STAGE_I);
  EXPECT(report.stages[0].witness.rule == MUFASA_RULE_MEAN_COST);
  EXPECT(report.stages[0].witness.compared[1] == 0.2);
  EXPECT(report.stages[1].reason == MUFASA_REASON_AFTER_FAILURE);

  /* A parked car 6 m ahead, in tracks and detections alike: stage iii. */
  set_up(&s);
  s.track_items[0].x = s.detection_items[0].x = 6;
  s.track_items[0].vx = 0;
  report = checked(&s.cycle);
  EXPECT(report.failed_stage == MUFASA_FAILED_STAGE_III);
  EXPECT(report.stages[2].witness.rule == MUFASA_RULE_COLLISION);
  EXPECT(report.stages[2].witness.has_track == 1 && report.stages[2].witness.track == 7);
  EXPECT(report.stages[2].witness.point == 0);

  /* Nothing but a grid with one occupied cell under the car: stage v. */
  set_up(&s);
  s.cycle.tracks = NULL;
  s.cycle.detections = NULL;
  s.bitmap[4] = 2;
  report = checked(&s.cycle);
  EXPECT(report.failed_stage == MUFASA_FAILED_STAGE_V);
  EXPECT(report.stages[4].witness.rule == MUFASA_RULE_OCCUPIED);
  EXPECT(report.stages[0].kind == MUFASA_OUTCOME_KIND_NOT_APPLICABLE);
  EXPECT(report.stages[0].missing == MUFASA_INPUT_TRACKS);

  /* Hardened: a cell under the car is unknown. */
  set_up(&s);
  s.cycle.profile = MUFASA_PROFILE_HARDENED;
  s.cycle.tracks = NULL;
  s.cycle.detections = NULL;
  s.cycle.lead = NULL;
  s.cycle.ego.speed = 0;
  uint8_t unknown[8] = {0};
  s.grid.x = -4;
  s.grid.unknown = unknown;
  s.grid.unknown_len = sizeof unknown;
  EXPECT(checked(&s.cycle).stages[4].witness.rule != MUFASA_RULE_UNKNOWN);
  unknown[4] = 1 << 5;
  report = checked(&s.cycle);
  EXPECT(report.failed_stage == MUFASA_FAILED_STAGE_V);
  EXPECT(report.stages[4].witness.rule == MUFASA_RULE_UNKNOWN);

  /* The hardened profile asks for more: with nothing to compare with, H-05. */
  set_up(&s);
  s.cycle.profile = MUFASA_PROFILE_HARDENED;
  s.cycle.tracks = NULL;
  s.cycle.detections = NULL;
  s.cycle.grid = NULL;
  s.cycle.lead = NULL;
  s.cycle.ego.speed = 0;
  report = checked(&s.cycle);
  EXPECT(!report.safe);
  EXPECT(report.failed_stage == MUFASA_FAILED_STAGE_NO_OBSTACLE_CHECK);
}

static void invalid_input(void) {
  struct scene s;
  double nan = strtod("nan", NULL);
  set_up(&s);
  s.track_items[0].vx = nan; /* remote */
  struct MufasaReport report = checked(&s.cycle);
  EXPECT(!report.safe);
  EXPECT(report.failed_stage == MUFASA_FAILED_STAGE_INPUT);
  EXPECT(strcmp(report.input.field, "tracks.items.vx") == 0);
  EXPECT(report.input.index == 0);

  s.cycle.ego.speed = nan; /* local goes first */
  report = checked(&s.cycle);
  EXPECT(report.failed_stage == MUFASA_FAILED_STAGE_ERROR);
  EXPECT(strcmp(report.input.field, "ego.speed") == 0);
  EXPECT(report.input.index == -1);
  EXPECT(strlen(report.input.message) > 10);

  /* A list that claims to be longer than any is refused by its length, and not read to its end. */
  static struct MufasaTrack many[1025];
  set_up(&s);
  s.tracks.items = many;
  s.tracks.items_len = SIZE_MAX;
  report = checked(&s.cycle);
  EXPECT(report.failed_stage == MUFASA_FAILED_STAGE_INPUT);
  EXPECT(strcmp(report.input.field, "tracks.items") == 0);
}

/* A history longer than the detections, in the memory that is said to be enough. */
static void history(void) {
  struct scene s;
  struct MufasaReport report;
  set_up(&s);
  struct MufasaDetection seen[8];
  for (size_t i = 0; i < 8; ++i) {
    seen[i] = s.detection_items[0];
    seen[i].y += 30 + (double)i;
  }
  struct MufasaDetectionList lists[2] = {
      {.stamp = AT(s.detections.stamp.ns - 300000000), .items = seen, .items_len = 8},
      {.stamp = AT(s.detections.stamp.ns - 500000000), .items = seen, .items_len = 3}};
  s.cycle.detection_history = lists;
  s.cycle.detection_history_len = 2;
  size_t enough = mufasa_scratch_bytes(&s.cycle);
  EXPECT(mufasa_check(&s.cycle, scratch, enough, &report) == MUFASA_STATUS_OK);
  EXPECT(report.safe);
  lists[1].stamp = lists[0].stamp;
  report = checked(&s.cycle);
  EXPECT(report.failed_stage == MUFASA_FAILED_STAGE_ERROR && report.input.index == 1);
  EXPECT(strcmp(report.input.field, "detection_history.stamp_ns") == 0);
}

static void faults_of_the_call(void) {
  struct scene s;
  struct MufasaReport report;
  set_up(&s);
  size_t enough = mufasa_scratch_bytes(&s.cycle);
  EXPECT(enough > 0 && enough < 4096);
  EXPECT(mufasa_scratch_bytes(NULL) == MUFASA_SCRATCH_BYTES_MAX);
  /* What is said to be enough is enough, at every alignment; nothing behind it is touched. */
  for (size_t start = 0; start < 16; ++start) {
    memset(scratch, 0x55, sizeof scratch);
    EXPECT(mufasa_check(&s.cycle, scratch + start, enough, &report) == MUFASA_STATUS_OK);
    EXPECT(report.safe);
    EXPECT(scratch[start + enough] == 0x55 && (start == 0 || scratch[start - 1] == 0x55));
  }
  for (size_t bytes = 0; bytes < enough - 64; bytes += 16) {
    memset(&report, 0, sizeof report);
    EXPECT(mufasa_check(&s.cycle, scratch, bytes, &report) == MUFASA_STATUS_MEMORY_TOO_SMALL);
    EXPECT(report.failed_stage == MUFASA_FAILED_STAGE_ERROR);
  }
  const MufasaStatus null = MUFASA_STATUS_NULL_POINTER;
  EXPECT(mufasa_check(NULL, scratch, sizeof scratch, &report) == null);
  EXPECT(report.failed_stage == MUFASA_FAILED_STAGE_ERROR);
  EXPECT(mufasa_check(&s.cycle, NULL, 100, &report) == null);
  EXPECT(mufasa_check(&s.cycle, scratch, sizeof scratch, NULL) == null);
  s.tracks.items = NULL;
  EXPECT(mufasa_check(&s.cycle, scratch, sizeof scratch, &report) == null);
  s.tracks.items_len = 0; /* an empty list needs no memory */
  EXPECT(mufasa_check(&s.cycle, scratch, sizeof scratch, &report) == MUFASA_STATUS_OK);
  set_up(&s);
  s.cycle.tracks = (const struct MufasaTrackList *)((const char *)&s.tracks + 1);
  EXPECT(mufasa_check(&s.cycle, scratch, sizeof scratch, &report) == MUFASA_STATUS_MISALIGNED);
  set_up(&s);
  s.cycle.profile = 3;
  EXPECT(mufasa_check(&s.cycle, scratch, sizeof scratch, &report) == MUFASA_STATUS_UNKNOWN_VALUE);
  set_up(&s);
  s.cycle.configuration = 0;
  EXPECT(mufasa_check(&s.cycle, scratch, sizeof scratch, &report) == MUFASA_STATUS_UNKNOWN_VALUE);
  EXPECT(report.failed_stage == MUFASA_FAILED_STAGE_ERROR);
}

int main(void) {
  verdicts();
  invalid_input();
  history();
  faults_of_the_call();
  return report_failures();
}
