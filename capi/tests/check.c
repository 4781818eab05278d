/* What the C interface promises, from C: verdicts, errors of the call, and a requester's trace. */
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

/* Lists that are indexed once: the same answers, and the items are not read again. */
static void indexes(void) {
  struct scene s;
  struct MufasaReport report;
  const struct MufasaDetectionIndex *kept[3] = {NULL, NULL, NULL};
  set_up(&s);
  struct MufasaDetection seen[8];
  for (size_t i = 0; i < 8; ++i) {
    seen[i] = s.detection_items[0];
    seen[i].y += 30 + (double)i;
  }
  struct MufasaDetectionList list = {AT(s.detections.stamp.ns - 300000000), seen, 8};
  s.cycle.profile = MUFASA_PROFILE_HARDENED;
  s.cycle.detection_history = &list;
  s.cycle.detection_history_len = 1;
  const struct MufasaReport plain = checked(&s.cycle);
  size_t bytes = mufasa_detection_index_bytes(8), enough = mufasa_scratch_bytes(&s.cycle);
  char *memory = malloc(bytes), *more = malloc(bytes);
  EXPECT(mufasa_detection_index_init(&list, memory, bytes, &kept[0]) == MUFASA_STATUS_OK);
  EXPECT(mufasa_detection_index_init(&s.detections, more, bytes, &kept[2]) == MUFASA_STATUS_OK);
  for (size_t len = 0; len <= 3; ++len) {
    EXPECT(mufasa_check_with(&s.cycle, kept, len, scratch, enough, &report) == MUFASA_STATUS_OK);
    EXPECT(report.safe == plain.safe && report.failed_stage == plain.failed_stage);
  }
  const double y = seen[5].y;
  seen[5].y = 1e300; /* not to be done: it shows what is read */
  EXPECT(mufasa_check_with(&s.cycle, kept, 3, scratch, enough, &report) == MUFASA_STATUS_OK);
  EXPECT(report.safe == plain.safe && checked(&s.cycle).failed_stage == MUFASA_FAILED_STAGE_ERROR);
  list.stamp.ns -= 1; /* another list in the same memory */
  EXPECT(mufasa_check_with(&s.cycle, kept, 3, scratch, enough, &report) == MUFASA_STATUS_OK);
  EXPECT(report.failed_stage == MUFASA_FAILED_STAGE_ERROR);
  EXPECT(mufasa_detection_index_init(&list, memory, bytes, kept) == MUFASA_STATUS_INVALID_LIST);
  EXPECT(kept[0] == NULL);
  seen[5].y = y;
  EXPECT(mufasa_detection_index_init(NULL, memory, bytes, &kept[0]) == MUFASA_STATUS_NULL_POINTER);
  EXPECT(mufasa_detection_index_init(&list, NULL, bytes, &kept[0]) == MUFASA_STATUS_NULL_POINTER);
  EXPECT(mufasa_detection_index_init(&list, memory, bytes, NULL) == MUFASA_STATUS_NULL_POINTER);
  EXPECT(mufasa_detection_index_init(&list, memory + 1, bytes, kept) == MUFASA_STATUS_MISALIGNED);
  EXPECT(mufasa_detection_index_init(&list, memory, bytes - 32, &kept[0]) ==
         MUFASA_STATUS_MEMORY_TOO_SMALL);
  EXPECT(mufasa_check_with(&s.cycle, NULL, 1, scratch, enough, &report) ==
         MUFASA_STATUS_NULL_POINTER);
  EXPECT(report.failed_stage == MUFASA_FAILED_STAGE_ERROR);
  free(memory);
  free(more);
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

static struct MufasaRequester *requester;
static struct MufasaAction actions[MUFASA_MAX_ACTIONS];

static size_t step(struct MufasaEvent event) {
  size_t count = 99;
  EXPECT(mufasa_requester_step(requester, &event, actions, MUFASA_MAX_ACTIONS, &count) ==
         MUFASA_STATUS_OK);
  return count;
}

static int is(size_t i, MufasaActionType type, MufasaGroup group, int64_t station, int64_t session) {
  return actions[i].action_type == type && actions[i].group == group &&
         actions[i].station == station && actions[i].session == session;
}

static struct MufasaRequesterState state(void) {
  struct MufasaRequesterState now;
  memset(&now, 0xff, sizeof now);
  EXPECT(mufasa_requester_state(requester, &now) == MUFASA_STATUS_OK);
  return now;
}

/* Two stations fit. */
static void init(MufasaProfile profile) {
  struct MufasaRequesterParameters parameters = mufasa_requester_parameters_default();
  size_t bytes = mufasa_requester_bytes(2);
  void *memory = malloc(bytes);
  MufasaStatus made = mufasa_requester_init(profile, &parameters, 2, memory, bytes, &requester);
  EXPECT(made == MUFASA_STATUS_OK);
  EXPECT((void *)requester == memory);
}

static void trace(void) {
  const uint32_t both = MUFASA_GROUP_MOT + MUFASA_GROUP_PLAN;
  init(MUFASA_PROFILE_PAPER);
  EXPECT(state().configuration == MUFASA_CONFIGURATION_LOCAL && !state().has_hold);
  EXPECT(step((struct MufasaEvent){
             .t = AT(0), .event_type = MUFASA_EVENT_TYPE_OFFER, .station = 1, .groups = both}) == 0);
  EXPECT(step((struct MufasaEvent){.t = AT(1), .event_type = MUFASA_EVENT_TYPE_TICK}) == 2);
  EXPECT(is(0, MUFASA_ACTION_TYPE_REQUEST, MUFASA_GROUP_MOT, 1, 1));
  EXPECT(is(1, MUFASA_ACTION_TYPE_REQUEST, MUFASA_GROUP_PLAN, 1, 2));
  EXPECT(state().mot.kind == MUFASA_GROUP_STATE_KIND_REQUESTED);
  EXPECT(state().mot.deadline.ns == 1 + SECOND / 2);
  EXPECT(step((struct MufasaEvent){.t = AT(2), .event_type = MUFASA_EVENT_TYPE_CONFIRM, .station = 1,
                                   .group = MUFASA_GROUP_MOT, .session = 1}) == 1);
  EXPECT(is(0, MUFASA_ACTION_TYPE_DEACTIVATE, MUFASA_GROUP_MOT, 0, 0));
  EXPECT(state().mot.source == 1 && state().plan.source == 0);
  EXPECT(state().configuration == MUFASA_CONFIGURATION_MOT_REMOTE);
  struct MufasaEvent data = {.t = AT(3), .event_type = MUFASA_EVENT_TYPE_DATA, .station = 1,
                             .group = MUFASA_GROUP_MOT, .session = 1, .generated = AT(1)};
  EXPECT(step(data) == 0);
  data.session = 2;
  EXPECT(step(data) == 1 && is(0, MUFASA_ACTION_TYPE_DROP, MUFASA_GROUP_MOT, 0, 0));

  /* An unsafe cycle: everything returns, and offloading is barred for t_wait. */
  EXPECT(step((struct MufasaEvent){.t = AT(4), .event_type = MUFASA_EVENT_TYPE_VERDICT, .safe = 0,
                                   .groups = MUFASA_GROUP_MOT}) == 3);
  EXPECT(is(0, MUFASA_ACTION_TYPE_RELEASE, MUFASA_GROUP_MOT, 1, 1));
  EXPECT(is(1, MUFASA_ACTION_TYPE_RELEASE, MUFASA_GROUP_PLAN, 1, 2));
  EXPECT(is(2, MUFASA_ACTION_TYPE_ACTIVATE, MUFASA_GROUP_MOT, 0, 0));
  EXPECT(state().has_hold == 1 && state().hold_until.ns == 4 + 10 * SECOND);
  struct MufasaEvent tick = {.t = AT(3 + 10 * SECOND), .event_type = MUFASA_EVENT_TYPE_TICK};
  EXPECT(step(tick) == 0);
  tick.t.ns += 1;
  EXPECT(step(tick) == 2 && is(0, MUFASA_ACTION_TYPE_REQUEST, MUFASA_GROUP_MOT, 1, 3));
  free(requester);
}

static void faults_of_the_requester(void) {
  struct MufasaRequesterParameters parameters = mufasa_requester_parameters_default();
  size_t bytes = mufasa_requester_bytes(1), count = 99;
  char *memory = malloc(bytes + 1);
  const uint32_t paper = MUFASA_PROFILE_PAPER;
  struct MufasaRequester *made = NULL;
  EXPECT(mufasa_requester_init(9, &parameters, 1, memory, bytes, &made) ==
         MUFASA_STATUS_UNKNOWN_VALUE);
  EXPECT(mufasa_requester_init(paper, NULL, 1, memory, bytes, &made) ==
         MUFASA_STATUS_NULL_POINTER);
  EXPECT(mufasa_requester_init(paper, &parameters, 1, NULL, bytes, &made) ==
         MUFASA_STATUS_NULL_POINTER);
  EXPECT(mufasa_requester_init(paper, &parameters, 1, memory + 1, bytes, &made) ==
         MUFASA_STATUS_MISALIGNED);
  EXPECT(mufasa_requester_init(paper, &parameters, 1, memory, bytes - 1, &made) ==
         MUFASA_STATUS_MEMORY_TOO_SMALL);
  EXPECT(mufasa_requester_init(paper, &parameters, SIZE_MAX, memory, bytes, &made) ==
         MUFASA_STATUS_MEMORY_TOO_SMALL);
  parameters.l_max_ns = -1;
  EXPECT(mufasa_requester_init(paper, &parameters, 1, memory, bytes, &made) ==
         MUFASA_STATUS_NEGATIVE_PARAMETER);
  EXPECT(made == NULL);
  free(memory);

  init(MUFASA_PROFILE_HARDENED);
  struct MufasaEvent event = {.event_type = MUFASA_EVENT_TYPE_OFFER, .groups = MUFASA_GROUP_MOT};
  EXPECT(mufasa_requester_step(requester, &event, actions, MUFASA_MAX_ACTIONS, &count) ==
         MUFASA_STATUS_INVALID_STATION);
  EXPECT(count == 0);
  event.station = 1;
  EXPECT(mufasa_requester_step(requester, &event, actions, MUFASA_MAX_ACTIONS - 1, &count) ==
         MUFASA_STATUS_TOO_FEW_ACTIONS);
  EXPECT(mufasa_requester_step(requester, NULL, actions, MUFASA_MAX_ACTIONS, &count) ==
         MUFASA_STATUS_NULL_POINTER);
  EXPECT(mufasa_requester_step(NULL, &event, actions, MUFASA_MAX_ACTIONS, &count) ==
         MUFASA_STATUS_NULL_POINTER);
  struct MufasaAction *odd = (struct MufasaAction *)((char *)actions + 1);
  EXPECT(mufasa_requester_step(requester, &event, odd, MUFASA_MAX_ACTIONS, &count) ==
         MUFASA_STATUS_MISALIGNED);
  EXPECT(mufasa_requester_step(requester, &event, NULL, MUFASA_MAX_ACTIONS, &count) ==
         MUFASA_STATUS_NULL_POINTER);
  EXPECT(mufasa_requester_step(requester, &event, actions, MUFASA_MAX_ACTIONS, NULL) ==
         MUFASA_STATUS_NULL_POINTER);
  event.groups = 4;
  EXPECT(mufasa_requester_step(requester, &event, actions, MUFASA_MAX_ACTIONS, &count) ==
         MUFASA_STATUS_UNKNOWN_VALUE);
  event.groups = MUFASA_GROUP_MOT;
  for (event.station = 1; event.station <= 2; ++event.station) EXPECT(step(event) == 0);
  EXPECT(mufasa_requester_step(requester, &event, actions, MUFASA_MAX_ACTIONS, &count) ==
         MUFASA_STATUS_TABLE_FULL);
  event.event_type = 10;
  EXPECT(mufasa_requester_step(requester, &event, actions, MUFASA_MAX_ACTIONS, &count) ==
         MUFASA_STATUS_UNKNOWN_VALUE);
  EXPECT(mufasa_requester_state(NULL, NULL) == MUFASA_STATUS_NULL_POINTER);
  EXPECT(mufasa_requester_state(requester, NULL) == MUFASA_STATUS_NULL_POINTER);
  free(requester);
}

int main(void) {
  verdicts();
  invalid_input();
  history();
  indexes();
  faults_of_the_call();
  trace();
  faults_of_the_requester();
  return report_failures();
}
