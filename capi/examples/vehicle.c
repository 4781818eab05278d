/* A vehicle loop at 20 Hz around the monitor, with a stand-in for the road and for a station. From 4 s to 5 s
 * the station's tracks are 3 m aside: the monitor falls back to the local services, waits t_wait, and
 * offloads again. Compiles as C and as C++. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "mufasa.h"

#define MS INT64_C(1000000)
/* As docs/configuration.md advises. */
#define PERIOD_MS 50
#define SECOND (1000 / PERIOD_MS) /* cycles */
#define CYCLES (20 * SECOND)
#define TAU (250 * MS)
#define BUILD_UP (100 * MS) /* from the command to full braking, the vehicle's own */
#define LOST (2 * SECOND) /* the cycle whose messages are lost */
#define CARS 2
#define POINTS 30
#define CROSS_SECTIONS 31

/* What the station was asked for: the sessions of MOT and PLAN, 0 for none. */
static int64_t asked[2], running[2];
static int planner_stands; /* whether the CAV's own planner is stopped */
static size_t fallbacks, ignored;

static void check(MufasaStatus status, const char *what) {
  if (status == MUFASA_STATUS_OK) return;
  fprintf(stderr, "%s: %s\n", what, mufasa_status_text(status));
  exit(1);
}

/* Where actions go: to the network, and to the vehicle's own services. */
static void take(const struct MufasaActions *actions) {
  for (size_t i = 0; i < actions->len; ++i) {
    const struct MufasaAction *action = &actions->items[i];
    const int plan = action->group == MUFASA_GROUP_PLAN;
    switch (action->action_type) {
      case MUFASA_ACTION_TYPE_REQUEST: asked[plan] = action->session; break;
      case MUFASA_ACTION_TYPE_RELEASE: running[plan] = 0; break;
      case MUFASA_ACTION_TYPE_ACTIVATE:
        printf("        local %s starts\n", plan ? "PLAN" : "MOT");
        if (plan) planner_stands = 0;
        break;
      case MUFASA_ACTION_TYPE_DEACTIVATE:
        printf("        local %s stops\n", plan ? "PLAN" : "MOT");
        if (plan) planner_stands = 1;
        break;
      case MUFASA_ACTION_TYPE_DROP: break; /* an element that the monitor did not take */
    }
  }
}

/* What the monitor says to a message, or to a tick. */
static void hear(MufasaStatus status, const struct MufasaActions *actions) {
  if (status == MUFASA_STATUS_TABLE_FULL || status == MUFASA_STATUS_INVALID_STATION) {
    /* A station can cause these two. Its message is ignored, and the loop goes on. */
    ++ignored;
    return;
  }
  check(status, "a call");
  take(actions);
}

static void step(struct MufasaMonitor *monitor, struct MufasaEvent event) {
  struct MufasaActions actions;
  hear(mufasa_monitor_step(monitor, &event, &actions), &actions);
}

static struct MufasaMonitor *make_monitor(void) {
  struct MufasaMonitorSettings settings = mufasa_monitor_settings_default(PERIOD_MS * MS);
  settings.most_detections = 16;
  settings.stages.tau = TAU / 1e9; /* from now of a cycle to braking with a_b: docs/assumptions.md, A-07 */
  struct MufasaMonitor *monitor;
  const size_t bytes = mufasa_monitor_bytes(&settings);
  check(mufasa_monitor_init(&settings, malloc(bytes), bytes, &monitor), "a monitor");

  static struct MufasaCrossSection road[CROSS_SECTIONS]; /* straight, 300 m, 6 m wide */
  for (int i = 0; i < CROSS_SECTIONS; ++i) {
    const double x = 10.0 * (i - 5);
    road[i].x = road[i].left[0] = road[i].right[0] = x;
    road[i].left[1] = 3.0;
    road[i].right[1] = -3.0;
  }
  struct MufasaRoute route;
  memset(&route, 0, sizeof route);
  route.cross_sections = road;
  route.cross_sections_len = CROSS_SECTIONS;
  check(mufasa_monitor_set_route(monitor, &route), "the route");
  return monitor;
}

/* The vehicle at 5 m/s, a car 20 m ahead and one beside the road; everything of one period. */
struct world {
  struct MufasaMonitorInputs inputs;
  struct MufasaLead lead;
  struct MufasaDetection detections[CARS];
  struct MufasaDetectionList detection_list;
  struct MufasaTrack tracks[CARS];
  struct MufasaTrajectoryPoint points[POINTS];
  struct MufasaTrajectory plan;
};

static void look(struct world *w, struct MufasaTime now, double aside) {
  memset(w, 0, sizeof *w);
  const double x = 5e-9 * (double)now.ns, front = x + 1.4 + 0.5 * 4.5, ahead = front + 20.0 + 2.25;
  struct MufasaEgo ego;
  ego.x = x, ego.y = 0, ego.cos = 1, ego.sin = 0, ego.speed = 5;
  ego.length = 4.5, ego.width = 1.9, ego.center_offset = 1.4;
  for (int i = 0; i < CARS; ++i) {
    struct MufasaDetection *seen = &w->detections[i];
    seen->x = ahead + 20.0 * i, seen->y = 8.0 * i;
    seen->cos = 1, seen->length = 4.5, seen->width = 1.9;
    struct MufasaTrack *track = &w->tracks[i];
    track->id = 7 + i, track->x = seen->x, track->y = seen->y + (i == 0 ? aside : 0.0);
    track->cos = 1, track->vx = 5, track->length = 4.5, track->width = 1.9;
  }
  for (int i = 0; i < POINTS; ++i) {
    w->points[i].t = mufasa_time_from_nanoseconds(now.ns + 100 * MS * i);
    w->points[i].x = x + 0.5 * i;
    w->points[i].cos = 1;
  }
  w->detection_list.stamp = w->lead.stamp = w->plan.stamp = now;
  w->detection_list.items = w->detections, w->detection_list.items_len = CARS;
  w->lead.gap = mufasa_gap_between_bumpers(20.0), w->lead.speed = 5.0;
  w->plan.points = w->points, w->plan.points_len = POINTS;
  w->inputs.ego = ego, w->inputs.detections = &w->detection_list, w->inputs.lead = &w->lead;
  w->inputs.local_trajectory = &w->plan;
}

/* What came over the network since the last period. */
static void receive(struct MufasaMonitor *monitor, struct MufasaTime now, const struct world *w) {
  struct MufasaActions actions;
  if (running[0] != 0) {
    struct MufasaTrackMessage message;
    message.station = 1, message.session = running[0], message.generated = now;
    message.tracks.stamp = now, message.tracks.items = w->tracks, message.tracks.items_len = CARS;
    hear(mufasa_monitor_tracks(monitor, now, &message, &actions), &actions);
  }
  if (running[1] != 0) {
    struct MufasaTrajectoryMessage message;
    message.station = 1, message.session = running[1], message.generated = now;
    message.trajectory = w->plan;
    hear(mufasa_monitor_trajectory(monitor, now, &message, &actions), &actions);
  }
}

int main(void) {
  const uint32_t version =
      MUFASA_VERSION_MAJOR * 1000000 + MUFASA_VERSION_MINOR * 1000 + MUFASA_VERSION_PATCH;
  if (mufasa_version() != version) return 2; /* another header than that of the library */
  struct MufasaMonitor *monitor = make_monitor();
  size_t offloaded = 0, copied = 0, advised = 0;
  struct MufasaTrajectoryPoint kept[POINTS]; /* what was followed last, verified or its own */
  size_t kept_len = 0;
  struct MufasaTime brake_by = mufasa_time_from_nanoseconds(INT64_MAX); /* of that */
  for (int cycle = 0; cycle < CYCLES; ++cycle) {
    /* The period after the loss comes 1 ms late, which a dt_max of two periods alone would not bear. */
    const struct MufasaTime now = mufasa_time_from_milliseconds(PERIOD_MS * cycle + (cycle == LOST + 1));
    struct MufasaEvent event;
    memset(&event, 0, sizeof event);
    event.t = now, event.station = 1;
    if (cycle == 0) {
      event.event_type = MUFASA_EVENT_TYPE_OFFER;
      event.groups = MUFASA_GROUP_MOT + MUFASA_GROUP_PLAN;
      step(monitor, event);
      event.station = 0;
      step(monitor, event);
      event.station = 1;
    }
    event.event_type = MUFASA_EVENT_TYPE_CONFIRM;
    for (int plan = 0; plan < 2; ++plan) {
      if (asked[plan] == 0) continue;
      event.group = plan ? MUFASA_GROUP_PLAN : MUFASA_GROUP_MOT;
      event.session = running[plan] = asked[plan];
      asked[plan] = 0;
      step(monitor, event);
    }
    event.event_type = MUFASA_EVENT_TYPE_TICK;
    step(monitor, event);

    struct world w;
    look(&w, now, cycle >= 4 * SECOND && cycle < 5 * SECOND ? 3.0 : 0.0);
    if (cycle != LOST) receive(monitor, now, &w);
    /* A planner that stands has no plan, also in the period in which it is told to start. */
    const int has_plan = !planner_stands;
    if (!has_plan) w.inputs.local_trajectory = NULL;

    /* The one way to what the station sent. */
    struct MufasaDecision decision;
    struct MufasaRequesterState state; /* before the cycle */
    check(mufasa_monitor_state(monitor, &state), "the state");
    /* Not OK: inputs of this program that nobody can check. It counts as unsafe, and the vehicle drives on. */
    const MufasaStatus status = mufasa_monitor_cycle(monitor, now, &w.inputs, &decision);
    if (status != MUFASA_STATUS_OK) fprintf(stderr, "a cycle: %s\n", mufasa_status_text(status));
    if (!decision.report.safe) {
      printf("%4.1f s: unsafe: %s, back to the local services\n", 0.001 * PERIOD_MS * cycle,
             mufasa_failed_stage_text(decision.report.failed_stage));
      ++fallbacks;
    }
    if ((cycle == LOST || cycle == LOST + 1) && decision.trajectory == NULL) return 1; /* it goes on with the one before */
    if (decision.trajectory != NULL) {
      ++offloaded;
      brake_by = decision.brake_by;
      kept_len = decision.trajectory->points_len;
      if (kept_len > POINTS) return 1;
      memcpy(kept, decision.trajectory->points, kept_len * sizeof *kept);
    } else if (has_plan && state.configuration == MUFASA_CONFIGURATION_LOCAL) { /* MON-67: of no other cycle */
      brake_by.ns = now.ns + TAU;
      kept_len = w.inputs.local_trajectory->points_len;
      if (kept_len > POINTS) return 1;
      memcpy(kept, w.inputs.local_trajectory->points, kept_len * sizeof *kept);
    } else if (now.ns + BUILD_UP < brake_by.ns) {
      /* No other is there, also after an unsafe cycle: it drives to the next point of the copy. By its brake_by the
         CAV brakes fully; control, which runs more often than cycles do, looks at that time itself. */
      size_t next = 0;
      while (next < kept_len && kept[next].t.ns <= now.ns) ++next;
      if (next < kept_len) ++copied;
    }
    /* What this program seems to get wrong: nothing. */
    if (decision.advice != MUFASA_ADVICE_NONE) {
      fprintf(stderr, "%s\n", mufasa_advice_text(decision.advice));
      ++advised;
    }
    take(&decision.actions);
  }
  printf("%zu of %d cycles offloaded, %zu fallback\n", offloaded, CYCLES, fallbacks);
  free(monitor);
  /* The last cycle was offloaded. */
  const int64_t covered_ns = brake_by.ns - PERIOD_MS * MS * (CYCLES - 1);
  return fallbacks == 1 && ignored == 1 && advised == 0 && copied == 1 && offloaded > 160 && covered_ns == 250 * MS ? 0 : 1;
}
