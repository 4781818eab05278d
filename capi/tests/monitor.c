/* What the monitor promises, from C: who gets data, what is refused, and that nothing is safe by default. */
#include <stdlib.h>
#include <string.h>

#include "expect.h"
#include "mufasa.h"

#define MS INT64_C(1000000)
#define AT(ns) mufasa_time_from_nanoseconds(ns)

static struct MufasaCrossSection road[2] = {{0, 0, {0, 3}, {0, -3}}, {200, 0, {200, 3}, {200, -3}}};
static const struct MufasaRoute route = {0, road, 2};
static struct MufasaDetection seen[2] = {{15, 0, 1, 0, 4.5, 1.8}, {25, 1, 1, 0, 4.5, 1.8}};
static struct MufasaDetectionList detections = {{{0}}, seen, 1};
static struct MufasaTrajectoryPoint points[3] = {{{{0}}, 0, 0, 1, 0}, {{{0}}, 0.5, 0, 1, 0}, {{{0}}, 1, 0, 1, 0}};
static struct MufasaTrack tracks[3] = {{7, 15, 0, 1, 0, 0, 0, 4.5, 1.8}, {8, 25, 1, 1, 0, 0, 0, 4.5, 1.8}};
static struct MufasaMonitorInputs inputs;
static struct MufasaLead lead = {{{0}}, {30}, 0};
static struct MufasaTrajectory own;
static struct MufasaActions actions;
static struct MufasaDecision decision;
static char memory[1 << 18];

static struct MufasaMonitorSettings settings(void) {
  struct MufasaMonitorSettings it = mufasa_monitor_settings_default(20 * MS);
  it.profile = MUFASA_PROFILE_PAPER;
  it.most_stations = it.most_tracks = it.most_detections = 2;
  it.most_points = 3;
  it.most_cross_sections = 2;
  return it;
}

static uint64_t a_tenth_later(void *context) {
  uint64_t *now = context;
  return *now += 100000;
}

static MufasaStatus make(const struct MufasaMonitorSettings *it, struct MufasaMonitor **monitor) {
  memset(memory, 0x55, sizeof memory);
  const size_t bytes = mufasa_monitor_bytes(it);
  EXPECT(bytes < sizeof memory);
  const MufasaStatus status = mufasa_monitor_init(it, memory, bytes, monitor);
  EXPECT(memory[bytes] == 0x55);
  return status;
}

static MufasaStatus step(struct MufasaMonitor *monitor, uint32_t type, int64_t t_ns, uint32_t group, int64_t session) {
  const struct MufasaEvent event = {.t = AT(t_ns), .event_type = type, .group = group, .groups = 3,
                                    .station = 1, .session = session};
  return mufasa_monitor_step(monitor, &event, &actions);
}

static struct MufasaRequesterState state(const struct MufasaMonitor *monitor) {
  struct MufasaRequesterState now;
  memset(&now, 0xff, sizeof now);
  EXPECT(mufasa_monitor_state(monitor, &now) == MUFASA_STATUS_OK);
  return now;
}

static int is(size_t i, MufasaActionType type, MufasaGroup group, int64_t station, int64_t session) {
  const struct MufasaAction *it = &actions.items[i];
  return i < actions.len && it->action_type == type && it->group == group && it->station == station &&
         it->session == session;
}

/* Both groups remote at 4 ms: sessions 1 and 2 of station 1. */
static struct MufasaMonitor *offloading(void) {
  const struct MufasaMonitorSettings it = settings();
  struct MufasaMonitor *monitor = NULL;
  EXPECT(make(&it, &monitor) == MUFASA_STATUS_OK);
  EXPECT(mufasa_monitor_set_route(monitor, &route) == MUFASA_STATUS_OK);
  EXPECT(step(monitor, MUFASA_EVENT_TYPE_OFFER, 0, 0, 0) == MUFASA_STATUS_OK && actions.len == 0);
  EXPECT(step(monitor, MUFASA_EVENT_TYPE_TICK, 1 * MS, 0, 0) == MUFASA_STATUS_OK && actions.len == 2);
  EXPECT(is(0, MUFASA_ACTION_TYPE_REQUEST, MUFASA_GROUP_MOT, 1, 1));
  EXPECT(is(1, MUFASA_ACTION_TYPE_REQUEST, MUFASA_GROUP_PLAN, 1, 2));
  EXPECT(state(monitor).mot.kind == MUFASA_GROUP_STATE_KIND_REQUESTED && state(monitor).mot.deadline.ns == 501 * MS);
  EXPECT(step(monitor, MUFASA_EVENT_TYPE_CONFIRM, 4 * MS, MUFASA_GROUP_MOT, 1) == MUFASA_STATUS_OK);
  EXPECT(actions.len == 1 && is(0, MUFASA_ACTION_TYPE_DEACTIVATE, MUFASA_GROUP_MOT, 0, 0));
  EXPECT(state(monitor).mot.source == 1 && state(monitor).plan.source == 0);
  EXPECT(step(monitor, MUFASA_EVENT_TYPE_CONFIRM, 4 * MS, MUFASA_GROUP_PLAN, 2) == MUFASA_STATUS_OK);
  EXPECT(state(monitor).configuration == MUFASA_CONFIGURATION_ALL_REMOTE && !state(monitor).has_hold);
  return monitor;
}

static int is_local(const struct MufasaMonitor *monitor) {
  return state(monitor).configuration == MUFASA_CONFIGURATION_LOCAL;
}

/* Tracks and a trajectory that agree with the detections, made 2 ms before `now_ns`. */
static MufasaStatus receive(struct MufasaMonitor *monitor, int64_t now_ns, int64_t session, size_t how_many) {
  const struct MufasaTrackMessage message = {1, session, AT(now_ns - 2 * MS), {AT(now_ns), tracks, how_many}};
  return mufasa_monitor_tracks(monitor, AT(now_ns), &message, &actions);
}

static MufasaStatus plan(struct MufasaMonitor *monitor, int64_t now_ns, int64_t session) {
  for (int i = 0; i < 3; ++i) points[i].t = AT(now_ns + 100 * MS * i);
  const struct MufasaTrajectoryMessage message = {1, session, AT(now_ns - 2 * MS), {AT(now_ns), points, 3}};
  return mufasa_monitor_trajectory(monitor, AT(now_ns), &message, &actions);
}

static void cycle(struct MufasaMonitor *monitor, int64_t now_ns) {
  EXPECT(step(monitor, MUFASA_EVENT_TYPE_TICK, now_ns, 0, 0) == MUFASA_STATUS_OK);
  detections.stamp = lead.stamp = own.stamp = AT(now_ns);
  memset(&decision, 0xff, sizeof decision);
  EXPECT(mufasa_monitor_cycle(monitor, AT(now_ns), &inputs, &decision) == MUFASA_STATUS_OK);
}

static void data_come_out_of_a_safe_cycle_alone(void) {
  struct MufasaMonitor *monitor = offloading();
  /* Nothing was received yet. */
  cycle(monitor, 5 * MS);
  EXPECT(decision.report.safe);
  EXPECT(decision.tracks == NULL && decision.trajectory == NULL);

  EXPECT(receive(monitor, 10 * MS, 1, 1) == MUFASA_STATUS_OK && actions.len == 0);
  EXPECT(plan(monitor, 10 * MS, 2) == MUFASA_STATUS_OK && actions.len == 0);
  tracks[0].x = -1e300; /* a copy was made */
  cycle(monitor, 11 * MS);
  EXPECT(decision.report.safe);
  EXPECT(decision.tracks != NULL && decision.tracks->items_len == 1);
  EXPECT(decision.tracks->items[0].id == 7 && decision.tracks->items[0].x == 15);
  EXPECT(decision.trajectory != NULL && decision.trajectory->points_len == 3);
  EXPECT(decision.trajectory->points[2].x == 1);
  EXPECT(decision.brake_by.ns == INT64_MAX); /* the paper profile */
  EXPECT(decision.local_services == 0);
  tracks[0].x = 15;

  /* Who kept the pointers has nothing after the next call. */
  const struct MufasaTrackList *old_list = decision.tracks;
  const struct MufasaTrajectory *old = decision.trajectory;
  const struct MufasaTrajectoryPoint *old_points = old->points;
  const struct MufasaTrack *old_tracks = old_list->items;

  /* Dropped: another session; not newer than the last. The last one used is still there. */
  EXPECT(receive(monitor, 12 * MS, 9, 2) == MUFASA_STATUS_OK);
  EXPECT(actions.len == 1 && actions.items[0].action_type == MUFASA_ACTION_TYPE_DROP);
  EXPECT(old->points == NULL && old->points_len == 0 && old_list->items == NULL && old_list->items_len == 0);
  EXPECT(old_points[0].x != old_points[0].x && old_points[2].x != old_points[2].x && old_tracks[0].x != old_tracks[0].x);
  EXPECT(receive(monitor, 10 * MS, 1, 2) == MUFASA_STATUS_OK && actions.len == 1);
  cycle(monitor, 13 * MS);
  EXPECT(decision.tracks != NULL && decision.tracks->items_len == 1);

  /* A track that nothing backs: unsafe, and nothing comes out, then or later. */
  tracks[0].x = 14;
  EXPECT(receive(monitor, 14 * MS, 1, 1) == MUFASA_STATUS_OK && actions.len == 0);
  cycle(monitor, 15 * MS);
  EXPECT(!decision.report.safe);
  EXPECT(decision.report.failed_stage == MUFASA_FAILED_STAGE_I);
  EXPECT(decision.tracks == NULL && decision.trajectory == NULL);
  EXPECT(decision.actions.len == 4 && is_local(monitor));
  EXPECT(state(monitor).has_hold == 1 && state(monitor).hold_until.ns == 10015 * MS);
  EXPECT(decision.local_services == MUFASA_GROUP_MOT + MUFASA_GROUP_PLAN);
  tracks[0].x = 15;
  EXPECT(receive(monitor, 16 * MS, 1, 1) == MUFASA_STATUS_OK && actions.len == 1);
  cycle(monitor, 17 * MS);
  EXPECT(decision.report.safe);
  EXPECT(decision.tracks == NULL && decision.trajectory == NULL);
}

/* Results stamped ahead of every cycle: silence, 2 dt_max and two periods after the confirmation at the latest. */
static void results_that_no_cycle_can_use_end_their_session(void) {
  struct MufasaMonitor *monitor = offloading();
  int64_t now_ns = 10 * MS;
  for (; !is_local(monitor) && now_ns < 1000 * MS; now_ns += 20 * MS) {
    const struct MufasaTrackMessage ahead = {1, 1, AT(now_ns), {AT(now_ns + 500 * MS), tracks, 1}};
    EXPECT(step(monitor, MUFASA_EVENT_TYPE_TICK, now_ns, 0, 0) == MUFASA_STATUS_OK);
    EXPECT(mufasa_monitor_tracks(monitor, AT(now_ns), &ahead, &actions) == MUFASA_STATUS_OK);
    const struct MufasaTrajectoryMessage plan = {1, 2, AT(now_ns), {AT(now_ns + 500 * MS), points, 3}};
    EXPECT(mufasa_monitor_trajectory(monitor, AT(now_ns), &plan, &actions) == MUFASA_STATUS_OK);
    cycle(monitor, now_ns);
    EXPECT(decision.report.safe);
    EXPECT(decision.tracks == NULL && decision.trajectory == NULL);
  }
  EXPECT(is_local(monitor) && now_ns > 104 * MS && now_ns - 20 * MS <= (4 + 2 * 100 + 2 * 20) * MS);
}

/* Only a tick notices silence. */
static void a_cycle_without_a_tick_is_unsafe(void) {
  struct MufasaMonitor *monitor = offloading();
  cycle(monitor, 5 * MS);
  EXPECT(decision.report.safe && !is_local(monitor));
  detections.stamp = lead.stamp = own.stamp = AT(6 * MS);
  EXPECT(mufasa_monitor_cycle(monitor, AT(6 * MS), &inputs, &decision) == MUFASA_STATUS_OK);
  EXPECT(decision.report.failed_stage == MUFASA_FAILED_STAGE_ERROR && is_local(monitor));
  EXPECT(strcmp(decision.report.input.field, "tick") == 0);
}

/* A fault of the call ends offloading like any unsafe cycle. */
static void faults_fall_back(void) {
  struct MufasaMonitor *monitor = offloading();
  memset(&decision, 0xff, sizeof decision);
  EXPECT(mufasa_monitor_cycle(monitor, AT(5 * MS), NULL, &decision) == MUFASA_STATUS_NULL_POINTER);
  EXPECT(decision.report.failed_stage == MUFASA_FAILED_STAGE_ERROR && decision.trajectory == NULL);
  EXPECT(decision.actions.len == 4 && is_local(monitor));
  monitor = offloading();
  detections.items_len = 3; /* more than the settings say */
  EXPECT(mufasa_monitor_cycle(monitor, AT(5 * MS), &inputs, &decision) == MUFASA_STATUS_MEMORY_TOO_SMALL);
  EXPECT(decision.report.failed_stage == MUFASA_FAILED_STAGE_ERROR && is_local(monitor));
  detections.items_len = 1;
  monitor = offloading();
  inputs.ego.width = -1; /* invalid local input */
  cycle(monitor, 5 * MS);
  EXPECT(decision.report.failed_stage == MUFASA_FAILED_STAGE_ERROR && is_local(monitor));
  EXPECT(strcmp(decision.report.input.field, "ego.width") == 0);
  inputs.ego.width = 1.9;
  EXPECT(mufasa_monitor_cycle(NULL, AT(6 * MS), &inputs, &decision) == MUFASA_STATUS_NULL_POINTER);
  EXPECT(decision.report.failed_stage == MUFASA_FAILED_STAGE_ERROR && decision.actions.len == 0);
  EXPECT(decision.local_services == MUFASA_GROUP_MOT + MUFASA_GROUP_PLAN);
}

/* Where the decision cannot be written nothing has happened: the tick is not used up, and no action is lost. */
static void a_decision_that_cannot_be_written_is_none(void) {
  static char place[sizeof(struct MufasaDecision) + 8];
  const size_t odd = ((size_t)place & 1) == 0; /* the address is odd then */
  struct MufasaDecision *const wrong[] = {NULL, (struct MufasaDecision *)(void *)(place + odd)};
  const MufasaStatus expected[] = {MUFASA_STATUS_NULL_POINTER, MUFASA_STATUS_MISALIGNED};
  struct MufasaMonitor *monitor = offloading();
  EXPECT(step(monitor, MUFASA_EVENT_TYPE_TICK, 5 * MS, 0, 0) == MUFASA_STATUS_OK);
  EXPECT(receive(monitor, 5 * MS, 1, 1) == MUFASA_STATUS_OK);
  detections.stamp = lead.stamp = own.stamp = AT(5 * MS);
  for (int i = 0; i < 2; i++) {
    EXPECT(mufasa_monitor_cycle(monitor, AT(5 * MS), &inputs, wrong[i]) == expected[i] && !is_local(monitor));
    EXPECT(mufasa_monitor_cycle(monitor, AT(5 * MS), NULL, wrong[i]) == expected[i] && !is_local(monitor));
    EXPECT(mufasa_monitor_cycle(NULL, AT(5 * MS), &inputs, wrong[i]) == expected[i]);
  }
  EXPECT(mufasa_monitor_cycle(monitor, AT(5 * MS), &inputs, &decision) == MUFASA_STATUS_OK);
  EXPECT(decision.report.safe && !is_local(monitor));
  EXPECT(decision.tracks != NULL);
}

/* A speed of the lead in km/h is told once; the gap stays the same, so that it is that of a lead at 5 m/s. */
static void what_contradicts_itself_is_told_once(void) {
  struct MufasaMonitor *monitor = offloading();
  int told = 0;
  lead.speed = 18;
  for (int64_t now_ns = 20 * MS; now_ns < 8000 * MS; now_ns += 20 * MS) {
    cycle(monitor, now_ns);
    EXPECT(decision.advice == MUFASA_ADVICE_NONE || decision.advice == MUFASA_ADVICE_LEAD_SPEED);
    told += decision.advice != MUFASA_ADVICE_NONE;
  }
  lead.speed = 0;
  EXPECT(told == 1 && strlen(mufasa_advice_text(MUFASA_ADVICE_LEAD_SPEED)) > 20);
  /* Of two in one cycle the second comes with the next call, though that cannot be read. */
  monitor = offloading();
  detections.stamp = lead.stamp = AT(0);
  for (int64_t now_ns = 1020 * MS; decision.advice == MUFASA_ADVICE_NONE && now_ns < 2000 * MS; now_ns += 20 * MS) {
    EXPECT(step(monitor, MUFASA_EVENT_TYPE_TICK, now_ns, 0, 0) == MUFASA_STATUS_OK);
    EXPECT(mufasa_monitor_cycle(monitor, AT(now_ns), &inputs, &decision) == MUFASA_STATUS_OK);
  }
  EXPECT(decision.advice == MUFASA_ADVICE_DETECTIONS_NOT_CURRENT);
  EXPECT(mufasa_monitor_cycle(monitor, AT(2000 * MS), NULL, &decision) == MUFASA_STATUS_NULL_POINTER);
  EXPECT(decision.advice == MUFASA_ADVICE_LEAD_NOT_CURRENT);
  EXPECT(strstr(mufasa_failed_stage_text(MUFASA_FAILED_STAGE_III), "stage iii,") != NULL);
}

static void messages_and_routes_that_are_refused(void) {
  struct MufasaMonitor *monitor = offloading();
  /* A list longer than the settings say is dropped, and no arrival: the session goes on. */
  EXPECT(receive(monitor, 6 * MS, 1, 3) == MUFASA_STATUS_OK && !is_local(monitor));
  EXPECT(actions.len == 1 && actions.items[0].action_type == MUFASA_ACTION_TYPE_DROP);
  EXPECT(actions.dropped == MUFASA_DROP_REASON_TOO_LONG);
  EXPECT(receive(monitor, 6 * MS, 9, 1) == MUFASA_STATUS_OK);
  EXPECT(actions.dropped == MUFASA_DROP_REASON_OTHER_SESSION);
  EXPECT(mufasa_monitor_tracks(monitor, AT(6 * MS), NULL, &actions) == MUFASA_STATUS_NULL_POINTER);
  EXPECT(mufasa_monitor_step(monitor, NULL, &actions) == MUFASA_STATUS_NULL_POINTER);
  EXPECT(mufasa_monitor_step(monitor, NULL, NULL) == MUFASA_STATUS_NULL_POINTER);
  struct MufasaRoute other = route;
  other.cross_sections_len = 1;
  EXPECT(mufasa_monitor_set_route(monitor, &other) == MUFASA_STATUS_INVALID_ROUTE);
  struct MufasaInvalidInput problem;
  EXPECT(mufasa_monitor_route_problem(monitor, &problem) == MUFASA_STATUS_OK);
  EXPECT(strcmp(problem.field, "route.stations") == 0 && strstr(problem.message, "too few") != NULL);
  EXPECT(mufasa_monitor_set_route(monitor, &route) == MUFASA_STATUS_OK);
  EXPECT(mufasa_monitor_route_problem(monitor, &problem) == MUFASA_STATUS_OK && problem.field[0] == 0);
  EXPECT(mufasa_monitor_set_route(monitor, NULL) == MUFASA_STATUS_NULL_POINTER);
  /* Late by 1 ns: the session ends. */
  const struct MufasaTrackMessage late = {1, 1, {{0}}, {AT(60 * MS), tracks, 1}};
  EXPECT(mufasa_monitor_tracks(monitor, AT(50 * MS + 1), &late, &actions) == MUFASA_STATUS_OK);
  EXPECT(actions.len == 3 && actions.items[0].action_type == MUFASA_ACTION_TYPE_DROP);
  EXPECT(actions.dropped == MUFASA_DROP_REASON_LATE);
}

/* What is refused changes nothing. */
static void events_and_calls_that_are_refused(void) {
  struct MufasaMonitor *monitor = offloading();
  struct MufasaEvent event = {.t = AT(5 * MS), .event_type = MUFASA_EVENT_TYPE_OFFER, .groups = 3};
  EXPECT(mufasa_monitor_step(monitor, &event, &actions) == MUFASA_STATUS_INVALID_STATION && actions.len == 0);
  event.station = 2;
  EXPECT(mufasa_monitor_step(NULL, &event, &actions) == MUFASA_STATUS_NULL_POINTER);
  struct MufasaActions *odd = (struct MufasaActions *)(void *)((char *)&actions + 1);
  EXPECT(mufasa_monitor_step(monitor, &event, odd) == MUFASA_STATUS_MISALIGNED);
  event.groups = 4;
  EXPECT(mufasa_monitor_step(monitor, &event, &actions) == MUFASA_STATUS_UNKNOWN_VALUE);
  event.groups = 3;
  EXPECT(mufasa_monitor_step(monitor, &event, &actions) == MUFASA_STATUS_OK && actions.len == 0);
  event.station = 3; /* two fit */
  EXPECT(mufasa_monitor_step(monitor, &event, &actions) == MUFASA_STATUS_TABLE_FULL);
  event.event_type = MUFASA_EVENT_TYPE_REJECT + 1;
  EXPECT(mufasa_monitor_step(monitor, &event, &actions) == MUFASA_STATUS_UNKNOWN_VALUE);
  EXPECT(step(monitor, MUFASA_EVENT_TYPE_REJECT, 5 * MS, 3, 1) == MUFASA_STATUS_UNKNOWN_VALUE);
  struct MufasaRequesterState now;
  EXPECT(mufasa_monitor_state(NULL, &now) == MUFASA_STATUS_NULL_POINTER);
  EXPECT(mufasa_monitor_state(monitor, NULL) == MUFASA_STATUS_NULL_POINTER);
  EXPECT(state(monitor).configuration == MUFASA_CONFIGURATION_ALL_REMOTE);
}

static struct MufasaSettingsProblem is_about(const struct MufasaMonitorSettings *it, MufasaStatus status,
                                             const char *field) {
  struct MufasaSettingsProblem problem;
  EXPECT(mufasa_monitor_settings_problem(it, &problem) == status);
  EXPECT(strcmp(problem.field, field) == 0);
  EXPECT((strlen(problem.message) > 0) == (status != MUFASA_STATUS_OK));
  return problem;
}

/* The field that is wrong, and the status of init. */
static void a_status_of_the_settings_has_a_field(void) {
  struct MufasaMonitorSettings it = settings();
  is_about(&it, MUFASA_STATUS_OK, "");
  it.stages.a_b = 0;
  is_about(&it, MUFASA_STATUS_INVALID_PARAMETER, "parameters.a_b");
  it = settings();
  it.stages.n = 65;
  struct MufasaSettingsProblem disks = is_about(&it, MUFASA_STATUS_INVALID_PARAMETER, "parameters.n");
  EXPECT(disks.value == 65 && disks.least == 1 && disks.most == 64);
  it = settings();
  it.period_ns = -1;
  is_about(&it, MUFASA_STATUS_INVALID_PERIOD, "period_ns");
  it.period_ns = 0;
  is_about(&it, MUFASA_STATUS_INVALID_PERIOD, "period_ns");
  it.period_ns = 100;
  is_about(&it, MUFASA_STATUS_TIME_TOO_SHORT, "period_ns");
  it = settings();
  it.requester.t_wait_ns = 10000;
  is_about(&it, MUFASA_STATUS_TIME_TOO_SHORT, "requester.t_wait_ns");
  struct MufasaMonitor *monitor = NULL;
  EXPECT(make(&it, &monitor) == MUFASA_STATUS_TIME_TOO_SHORT && monitor == NULL);
  it.requester.t_wait_ns = -1;
  is_about(&it, MUFASA_STATUS_NEGATIVE_PARAMETER, "requester.t_wait_ns");
  it.requester.t_wait_ns = 1000 * MS - 1;
  is_about(&it, MUFASA_STATUS_TIME_TOO_SHORT, "requester.t_wait_ns");
  it = settings();
  it.requester.l_max_ns = it.stages.max_age_ns + 1;
  is_about(&it, MUFASA_STATUS_MAX_AGE_BELOW_L_MAX, "parameters.max_age_ns");
  it = settings();
  it.stages.tau = 0.02;
  is_about(&it, MUFASA_STATUS_OK, "");
  it.profile = MUFASA_PROFILE_HARDENED;
  struct MufasaSettingsProblem problem = is_about(&it, MUFASA_STATUS_TAU_NOT_ABOVE_PERIOD, "parameters.tau");
  EXPECT(problem.value == 0.02 && problem.least == 0.02 && problem.most != problem.most);
  it = settings();
  it.check_time_ns = -1;
  is_about(&it, MUFASA_STATUS_INVALID_PARAMETER, "check_time_ns");
  /* The default takes the default's lists, and not four times as many cross sections. */
  it = mufasa_monitor_settings_default(50 * MS);
  is_about(&it, MUFASA_STATUS_OK, "");
  it.most_cross_sections = 4096;
  problem = is_about(&it, MUFASA_STATUS_TOO_SLOW, "most_cross_sections");
  EXPECT(problem.value == 4096 && problem.most >= 528 && problem.most < 4096);
  it.most_cross_sections = (uint32_t)problem.most;
  is_about(&it, MUFASA_STATUS_OK, "");
  it.most_stations = 1000000;
  problem = is_about(&it, MUFASA_STATUS_TOO_SLOW, "most_stations");
  EXPECT(problem.value == 1000000 && problem.most >= 8 && problem.most < 1000000);
  it.check_time_ns = INT64_MAX;
  is_about(&it, MUFASA_STATUS_OK, "");
  it = settings();
  it.check_time_ns = 1000;
  EXPECT(make(&it, &monitor) == MUFASA_STATUS_TOO_SLOW && monitor == NULL);
  uint64_t now = 0;
  EXPECT(mufasa_monitor_calibrate(a_tenth_later, &now) == 1000 && now == 400000);
  EXPECT(mufasa_monitor_calibrate(NULL, NULL) == 0);
  it = settings();
  it.stages.a_b = 80;
  problem = is_about(&it, MUFASA_STATUS_UNUSUAL, "stages.a_b");
  EXPECT(problem.value == 80 && 0 < problem.least && problem.least < problem.most && problem.most < 80);
  EXPECT(make(&it, &monitor) == MUFASA_STATUS_UNUSUAL && monitor == NULL);
  it.meant = mufasa_monitor_meant("stages.tau") + mufasa_monitor_meant("no such") + mufasa_monitor_meant(NULL);
  is_about(&it, MUFASA_STATUS_UNUSUAL, "stages.a_b");
  it.meant += mufasa_monitor_meant("stages.a_b");
  is_about(&it, MUFASA_STATUS_OK, "");
  it = settings();
  it.most_tracks = 0;
  is_about(&it, MUFASA_STATUS_MEMORY_TOO_SMALL, "most_tracks");
  EXPECT(make(&it, &monitor) == MUFASA_STATUS_MEMORY_TOO_SMALL);
  EXPECT(mufasa_monitor_settings_problem(NULL, &problem) == MUFASA_STATUS_NULL_POINTER);
  EXPECT(mufasa_monitor_settings_problem(&it, NULL) == MUFASA_STATUS_NULL_POINTER);
  struct MufasaInvalidInput of_route;
  EXPECT(mufasa_monitor_route_problem(NULL, &of_route) == MUFASA_STATUS_NULL_POINTER);
}

static void settings_that_no_monitor_can_keep(void) {
  struct MufasaMonitorSettings it = settings();
  struct MufasaMonitor *monitor = (struct MufasaMonitor *)memory;
  it.requester.dt_max_ns = it.period_ns;
  EXPECT(make(&it, &monitor) == MUFASA_STATUS_DT_MAX_NOT_ABOVE_PERIOD && monitor == NULL);
  it = settings();
  it.period_ns = 0;
  EXPECT(make(&it, &monitor) == MUFASA_STATUS_INVALID_PERIOD);
  it = settings();
  it.stages.a_b = 0;
  EXPECT(make(&it, &monitor) == MUFASA_STATUS_INVALID_PARAMETER);
  it = settings();
  it.sessions_before = -1;
  EXPECT(make(&it, &monitor) == MUFASA_STATUS_NEGATIVE_PARAMETER);
  it = settings();
  it.profile = 7;
  EXPECT(make(&it, &monitor) == MUFASA_STATUS_UNKNOWN_VALUE);
  it = settings();
  const size_t bytes = mufasa_monitor_bytes(&it);
  EXPECT(mufasa_monitor_bytes(NULL) == SIZE_MAX);
  EXPECT(mufasa_monitor_init(&it, memory, bytes - 1, &monitor) == MUFASA_STATUS_MEMORY_TOO_SMALL);
  EXPECT(mufasa_monitor_init(&it, memory + 1, bytes, &monitor) == MUFASA_STATUS_MISALIGNED);
  EXPECT(mufasa_monitor_init(&it, NULL, bytes, &monitor) == MUFASA_STATUS_NULL_POINTER);
  EXPECT(mufasa_monitor_init(NULL, memory, bytes, &monitor) == MUFASA_STATUS_NULL_POINTER);
  it.most_tracks = SIZE_MAX;
  EXPECT(mufasa_monitor_init(&it, memory, bytes, &monitor) == MUFASA_STATUS_MEMORY_TOO_SMALL);
}

/* Each unit is the same time; one that does not fit is none of which anything is current. */
static void times_have_units(void) {
  const int64_t ns = 5000 * MS;
  EXPECT(mufasa_time_from_nanoseconds(ns).ns == ns && mufasa_time_from_microseconds(ns / 1000).ns == ns);
  EXPECT(mufasa_time_from_milliseconds(5000).ns == ns);
  EXPECT(mufasa_time_from_microseconds(INT64_MAX / 1000 + 1).ns == INT64_MIN);
  EXPECT(mufasa_time_from_milliseconds(INT64_MAX).ns == INT64_MIN);
  struct MufasaTime time;
  EXPECT(mufasa_time_from_seconds(5.0, &time) == MUFASA_STATUS_OK && time.ns == ns);
  EXPECT(mufasa_time_from_seconds(1e300, &time) == MUFASA_STATUS_UNKNOWN_VALUE && time.ns == INT64_MIN);
  EXPECT(mufasa_time_from_seconds(strtod("nan", NULL), &time) == MUFASA_STATUS_UNKNOWN_VALUE && time.ns == INT64_MIN);
  EXPECT(mufasa_time_from_seconds(5.0, NULL) == MUFASA_STATUS_NULL_POINTER);
  EXPECT(mufasa_gap_between_bumpers(2.5).between_bumpers == 2.5);
}

/* Only where it was asked for, the CAV's own plan is examined while all groups are local. */
static void own_plans_that_fail_say_brake(void) {
  struct MufasaMonitorSettings it = settings();
  struct MufasaMonitor *monitor = NULL;
  for (it.supervise_local = 0; it.supervise_local < 2; ++it.supervise_local) {
    EXPECT(make(&it, &monitor) == MUFASA_STATUS_OK);
    EXPECT(mufasa_monitor_set_route(monitor, &route) == MUFASA_STATUS_OK);
    cycle(monitor, 5 * MS);
    EXPECT(decision.brake.reason == (it.supervise_local ? MUFASA_BRAKE_REASON_NO_PLAN : MUFASA_BRAKE_REASON_NONE));
    for (int i = 0; i < 3; ++i) points[i].t = AT((10 + 100 * i) * MS);
    own.points = points, own.points_len = 3;
    inputs.local_trajectory = &own;
    cycle(monitor, 10 * MS);
    EXPECT(decision.report.safe && decision.brake.reason == MUFASA_BRAKE_REASON_NONE);
    seen[0].x = 5.5;
    cycle(monitor, 15 * MS);
    EXPECT(decision.brake.reason == (it.supervise_local ? MUFASA_BRAKE_REASON_FAILS : MUFASA_BRAKE_REASON_NONE));
    EXPECT(decision.brake.failed_stage == (it.supervise_local ? MUFASA_FAILED_STAGE_IV : MUFASA_FAILED_STAGE_NONE));
    EXPECT(!it.supervise_local || decision.brake.witness.detection == 0);
    seen[0].x = 15;
    inputs.ego.width = -1;
    cycle(monitor, 20 * MS);
    EXPECT(decision.brake.reason == (it.supervise_local ? MUFASA_BRAKE_REASON_INVALID : MUFASA_BRAKE_REASON_NONE));
    EXPECT(!it.supervise_local || strcmp(decision.brake.input.field, "ego.width") == 0);
    inputs.ego.width = 1.9;
    inputs.local_trajectory = NULL;
    EXPECT(mufasa_monitor_cycle(monitor, AT(25 * MS), NULL, &decision) == MUFASA_STATUS_NULL_POINTER);
    EXPECT(decision.brake.reason == (it.supervise_local ? MUFASA_BRAKE_REASON_INVALID : MUFASA_BRAKE_REASON_NONE));
  }
  EXPECT(mufasa_monitor_given_back(monitor).ns == INT64_MIN && mufasa_monitor_given_back(NULL).ns == INT64_MIN);
}

int main(void) {
  inputs.ego = (struct MufasaEgo){0, 0, 1, 0, 5, 4.8, 1.9, 1.4};
  inputs.detections = &detections;
  inputs.lead = &lead;
  data_come_out_of_a_safe_cycle_alone();
  results_that_no_cycle_can_use_end_their_session();
  a_cycle_without_a_tick_is_unsafe();
  faults_fall_back();
  a_decision_that_cannot_be_written_is_none();
  messages_and_routes_that_are_refused();
  events_and_calls_that_are_refused();
  what_contradicts_itself_is_told_once();
  settings_that_no_monitor_can_keep();
  a_status_of_the_settings_has_a_field();
  times_have_units();
  own_plans_that_fail_say_brake();
  EXPECT(mufasa_version() ==
         MUFASA_VERSION_MAJOR * 1000000 + MUFASA_VERSION_MINOR * 1000 + MUFASA_VERSION_PATCH);
  return report_failures();
}
