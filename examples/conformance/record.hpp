// The record `cycle`: its schema (spec/5-interfaces.md#cycle), then the domain of its values
// (spec/3-stages.md#invalid-input, spec/4-arithmetic.md#domain).
#pragma once

#include <algorithm>
#include <optional>
#include <set>

#include "json.hpp"

// A value is outside its domain.
struct Invalid {};

struct Point { double x, y; };
struct Pose : Point { double cos, sin; };
struct Box : Pose { double length, width; };
struct Ego : Box { double speed, center_offset; };
struct Object : Box { std::int64_t id; double vx, vy; };  // a track; a detection stands still
struct TrajectoryPoint : Pose { std::int64_t t_ns; };
struct Station : Point { Point left, right; };
struct Lead { std::int64_t stamp_ns; double gap, speed; };
template <class T> struct Stamped { std::int64_t stamp_ns; std::vector<T> items; };
struct Grid : Pose {
  std::int64_t stamp_ns, width, height;
  double resolution;
  std::string occupied;
  std::optional<std::string> unknown;
};
struct Parameters {
  double theta_tr = 0.2, theta_map = 0.3, theta_obj = 5.0, a_b = 8.0, safety_time = 1.8;
  double theta_track_max = 1.0, tau = 0.1, a_max = 3.0, start_tolerance = 2.0, v_max = 150.0;
  double theta_velocity = 2.0, lateral_tolerance = 0.5, v_object = 70.0;
  double t_yield = 2.0, a_yield = 3.0;
  double delta = 1e-6;
  std::int64_t max_age_ns = 100000000, n = 4, miss_budget = 4, step_max_ns = 200000000,
               work_limit = 700000;
};
struct Cycle {
  Parameters parameters;
  std::int64_t now_ns;
  std::string configuration;
  Ego ego;
  std::optional<Stamped<TrajectoryPoint>> trajectory;
  std::optional<Stamped<Object>> tracks, detections;
  std::vector<Stamped<Object>> detection_history;
  std::optional<Lead> lead;
  bool closed;
  std::vector<Station> stations;
  std::optional<Grid> grid;
};

// Schema.

inline void read_pose(const Value& v, Pose& p) {
  p.x = v.at("x").as_double();
  p.y = v.at("y").as_double();
  p.cos = v.at("cos").as_double();
  p.sin = v.at("sin").as_double();
}
inline void read_box(const Value& v, Box& b) {
  read_pose(v, b);
  b.length = v.at("length").as_double();
  b.width = v.at("width").as_double();
}
inline Object read_detection(const Value& v) {
  Object o{};
  read_box(v.only({"x", "y", "cos", "sin", "length", "width"}), o);
  return o;
}
inline Object read_track(const Value& v) {
  Object o{};
  read_box(v.only({"id", "x", "y", "cos", "sin", "vx", "vy", "length", "width"}), o);
  o.id = v.at("id").as_integer();
  o.vx = v.at("vx").as_double();
  o.vy = v.at("vy").as_double();
  return o;
}
inline TrajectoryPoint read_trajectory_point(const Value& v) {
  TrajectoryPoint p{};
  read_pose(v.only({"t_ns", "x", "y", "cos", "sin"}), p);
  p.t_ns = v.at("t_ns").as_integer();
  return p;
}
inline Point read_pair(const Value& v) {
  if (v.as_list().size() != 2) throw Broken{};
  return {v.items[0].as_double(), v.items[1].as_double()};
}
inline Station read_station(const Value& v) {
  v.only({"x", "y", "left", "right"});
  Station s{};
  s.x = v.at("x").as_double();
  s.y = v.at("y").as_double();
  s.left = read_pair(v.at("left"));
  s.right = read_pair(v.at("right"));
  return s;
}
inline Lead read_lead(const Value& v) {
  v.only({"stamp_ns", "gap", "speed"});
  return {v.at("stamp_ns").as_integer(), v.at("gap").as_double(), v.at("speed").as_double()};
}
inline std::string read_base64(const Value& v) {
  static const std::string alphabet =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const std::string& text = v.as_string();
  std::string bytes;
  std::size_t end = text.size();
  for (int i = 0; i < 2 && end && text[end - 1] == '='; ++i) --end;
  if (text.size() % 4 || end % 4 == 1) throw Broken{};
  unsigned bits = 0;
  for (std::size_t i = 0; i < end; ++i) {
    std::size_t digit = alphabet.find(text[i]);
    if (digit == std::string::npos) throw Broken{};
    bits = bits << 6 | unsigned(digit);
    if (i % 4) bytes += char(bits >> (6 - 2 * (i % 4)) & 0xff);
  }
  // Two digits hold 4 bits more than a byte, three hold 2 more than two: these are zero.
  if (bits & (end % 4 == 2 ? 15u : end % 4 == 3 ? 3u : 0u)) throw Broken{};
  return bytes;
}
inline Grid read_grid(const Value& v) {
  v.only({"stamp_ns", "x", "y", "cos", "sin", "resolution", "width", "height", "occupied",
          "unknown"});
  Grid g{};
  read_pose(v, g);
  g.stamp_ns = v.at("stamp_ns").as_integer();
  g.width = v.at("width").as_integer();
  g.height = v.at("height").as_integer();
  g.resolution = v.at("resolution").as_double();
  g.occupied = read_base64(v.at("occupied"));
  if (const Value* unknown = v.given("unknown")) g.unknown = read_base64(*unknown);
  return g;
}
template <class T>
std::optional<Stamped<T>> read_list(const Value* v, const char* key, T (*read)(const Value&)) {
  if (!v) return std::nullopt;
  Stamped<T> result{v->only({"stamp_ns", key}).at("stamp_ns").as_integer(), {}};
  for (auto& item : v->at(key).as_list()) result.items.push_back(read(item));
  return result;
}
inline void read_parameters(const Value& v, Parameters& p) {
  v.only({"theta_tr", "theta_map", "theta_obj", "a_b", "safety_time", "max_age_ns", "n",
          "theta_track_max", "miss_budget", "tau", "a_max", "start_tolerance", "v_max",
          "step_max_ns", "theta_velocity", "lateral_tolerance", "v_object", "t_yield", "a_yield",
          "work_limit", "delta", "t_wait_ns", "request_timeout_ns", "l_max_ns", "dt_max_ns"});
  const std::pair<const char*, double*> numbers[] = {
      {"theta_tr", &p.theta_tr}, {"theta_map", &p.theta_map}, {"theta_obj", &p.theta_obj},
      {"a_b", &p.a_b}, {"safety_time", &p.safety_time}, {"tau", &p.tau}, {"a_max", &p.a_max},
      {"theta_track_max", &p.theta_track_max}, {"start_tolerance", &p.start_tolerance},
      {"v_max", &p.v_max}, {"theta_velocity", &p.theta_velocity}, {"v_object", &p.v_object},
      {"lateral_tolerance", &p.lateral_tolerance}, {"t_yield", &p.t_yield},
      {"a_yield", &p.a_yield}, {"delta", &p.delta}};
  for (auto& [name, place] : numbers)
    if (const Value* value = v.find(name)) *place = value->as_double();
  std::int64_t time_ns = 0;
  const std::pair<const char*, std::int64_t*> integers[] = {
      {"max_age_ns", &p.max_age_ns}, {"n", &p.n}, {"miss_budget", &p.miss_budget},
      {"step_max_ns", &p.step_max_ns}, {"work_limit", &p.work_limit}, {"t_wait_ns", &time_ns},
      {"l_max_ns", &time_ns}, {"request_timeout_ns", &time_ns}, {"dt_max_ns", &time_ns}};
  for (auto& [name, place] : integers) {
    if (const Value* value = v.find(name)) *place = value->as_integer();
    if (time_ns < 0) throw Broken{};
  }
}
inline Cycle read_cycle(const Value& v) {
  v.only({"kind", "id", "profile", "parameters", "now_ns", "configuration", "ego", "trajectory",
          "tracks", "detections", "lead", "route", "grid", "detection_history"});
  // This program knows the published method only.
  if (v.at("profile").as_string() != "paper") throw Broken{};
  Cycle c{};
  if (const Value* parameters = v.find("parameters")) read_parameters(*parameters, c.parameters);
  c.now_ns = v.at("now_ns").as_integer();
  c.configuration = v.at("configuration").as_string();
  const char* names[] = {"Local", "MotRemote", "AllRemote", "PlanRemote"};
  if (std::count(std::begin(names), std::end(names), c.configuration) != 1) throw Broken{};
  const Value& ego = v.at("ego").only(
      {"x", "y", "cos", "sin", "speed", "length", "width", "center_offset"});
  read_box(ego, c.ego);
  c.ego.speed = ego.at("speed").as_double();
  c.ego.center_offset = ego.at("center_offset").as_double();
  c.trajectory = read_list(v.given("trajectory"), "points", read_trajectory_point);
  c.tracks = read_list(v.given("tracks"), "items", read_track);
  c.detections = read_list(v.given("detections"), "items", read_detection);
  if (const Value* lead = v.given("lead")) c.lead = read_lead(*lead);
  const Value& route = v.at("route").only({"closed", "stations"});
  c.closed = route.at("closed").as_boolean();
  for (auto& item : route.at("stations").as_list()) c.stations.push_back(read_station(item));
  if (const Value* grid = v.given("grid")) c.grid = read_grid(*grid);
  if (const Value* history = v.given("detection_history"))
    for (auto& list : history->as_list())
      c.detection_history.push_back(*read_list(&list, "items", read_detection));
  return c;
}

// Domain.

constexpr std::int64_t kS60 = 60000000000;

template <class T> void within(T value, T least, T most) {
  if (!(least <= value && value <= most)) throw Invalid{};
}
// Whether cos^2 + sin^2 is within 1e-6 of 1, without a rounding: each square as a sum of two
// doubles, and the large parts cancel exactly.
inline bool is_direction(double cos, double sin) {
  double large = std::max(std::fabs(cos), std::fabs(sin));
  double small = std::min(std::fabs(cos), std::fabs(sin));
  double a = large * large, b = small * small;
  double rest_a = std::fma(large, large, -a), rest_b = std::fma(small, small, -b);
  double top = a - 1, sum = top + b, part = sum - top;
  double rest = (top - (sum - part)) + (b - part) + rest_a + rest_b;
  return (sum - 1e-6) + rest <= 0 && (sum + 1e-6) + rest >= 0;
}
inline void check_pose(const Pose& p) {
  const double far = 16777216.0;
  within(p.x, -far, far);
  within(p.y, -far, far);
  within(p.cos, -2.0, 2.0);
  within(p.sin, -2.0, 2.0);
  if (!is_direction(p.cos, p.sin)) throw Invalid{};
}
inline void check_box(const Box& b) {
  check_pose(b);
  within(b.length, 0.01, 100.0);
  within(b.width, 0.01, 100.0);
}
// later - earlier, at the limits of 64 bits when it is beyond them.
inline std::int64_t elapsed_ns(std::int64_t earlier, std::int64_t later) {
  using limits = std::numeric_limits<std::int64_t>;
  if (earlier < 0 && later > limits::max() + earlier) return limits::max();
  if (earlier > 0 && later < limits::min() + earlier) return limits::min();
  return later - earlier;
}
// Whether the time is not too old to be used.
inline bool check_time(std::int64_t t_ns, std::int64_t now_ns, bool remote) {
  std::int64_t age_ns = elapsed_ns(t_ns, now_ns);
  if (age_ns < -kS60 || (remote && age_ns > kS60)) throw Invalid{};
  return age_ns <= kS60;
}
inline void check_list(const std::optional<Stamped<Object>>& list, const Cycle& c, bool remote,
                       bool tracks) {
  if (!list) return;
  check_time(list->stamp_ns, c.now_ns, remote);
  within<std::size_t>(list->items.size(), 0, tracks ? 1024 : 2048);
  std::set<std::int64_t> ids;
  for (auto& item : list->items) {
    check_box(item);
    within(item.vx, -150.0, 150.0);
    within(item.vy, -150.0, 150.0);
    if (tracks && !ids.insert(item.id).second) throw Invalid{};
  }
}
inline void check_trajectory(Cycle& c, bool remote) {
  if (!c.trajectory) return;
  // An old local trajectory counts as missing: then its points may be old, too.
  bool usable = check_time(c.trajectory->stamp_ns, c.now_ns, remote);
  const auto& points = c.trajectory->items;
  within<std::size_t>(points.size(), 1, 1024);
  for (std::size_t i = 0; i < points.size(); ++i) {
    check_time(points[i].t_ns, c.now_ns, usable);
    check_pose(points[i]);
    if (i && points[i - 1].t_ns >= points[i].t_ns) throw Invalid{};
  }
  if (!usable) c.trajectory.reset();
}
inline void check_parameters(const Parameters& p) {
  const double least = std::numeric_limits<double>::denorm_min();
  for (double theta : {p.theta_tr, p.theta_map, p.theta_obj, p.theta_track_max,
                       p.start_tolerance, p.lateral_tolerance})
    within(theta, 1e-3, 1e3);
  for (double a : {p.a_b, p.a_max, p.a_yield}) within(a, 0.1, 100.0);
  for (double time : {p.safety_time, p.tau, p.t_yield}) within(time, 0.0, 60.0);
  for (double speed : {p.v_max, p.theta_velocity, p.v_object}) within(speed, least, 1e3);
  for (std::int64_t time_ns : {p.max_age_ns, p.step_max_ns}) within<std::int64_t>(time_ns, 0, kS60);
  within<std::int64_t>(p.n, 1, 64);
  within<std::int64_t>(p.miss_budget, 0, 64);
  within<std::int64_t>(p.work_limit, 0, std::numeric_limits<std::int64_t>::max());
  within(p.delta, 1e-8, 1e-2);
}
inline void check_grid(const Grid& g) {
  check_pose(g);
  within(g.resolution, 0.01, 10.0);
  within<std::int64_t>(g.width, 1, 1 << 15);
  within<std::int64_t>(g.height, 1, 1 << 15);
  within<std::int64_t>(g.width * g.height, 1, 1 << 24);
  std::size_t bytes = std::size_t(g.width * g.height + 7) / 8;
  if (g.occupied.size() != bytes || (g.unknown && g.unknown->size() != bytes)) throw Invalid{};
}
inline void check_route(const std::vector<Station>& stations) {
  const double far = 16777216.0;
  within<std::size_t>(stations.size(), 2, 8192);
  for (std::size_t i = 0; i < stations.size(); ++i) {
    const Station& s = stations[i];
    for (double value : {s.x, s.y, s.left.x, s.left.y, s.right.x, s.right.y})
      within(value, -far, far);
    if (i && stations[i - 1].x == s.x && stations[i - 1].y == s.y) throw Invalid{};
  }
}
// Whether remote data are valid; throws Invalid for local data.
inline bool check_input(Cycle& c) {
  bool remote_tracks = c.configuration == "MotRemote" || c.configuration == "AllRemote";
  bool remote_trajectory = c.configuration == "AllRemote" || c.configuration == "PlanRemote";
  check_parameters(c.parameters);
  check_box(c.ego);
  within(c.ego.speed, 0.0, 150.0);
  within(c.ego.center_offset, -100.0, 100.0);
  if (c.lead) {
    check_time(c.lead->stamp_ns, c.now_ns, false);
    within(c.lead->gap, 0.0, 1e6);
    within(c.lead->speed, 0.0, 150.0);
  }
  check_route(c.stations);
  if (c.grid) check_time(c.grid->stamp_ns, c.now_ns, false), check_grid(*c.grid);
  check_list(c.detections, c, false, false);
  within<std::size_t>(c.detection_history.size(), 0, 4);
  for (std::size_t i = 0; i < c.detection_history.size(); ++i) {
    check_list(c.detection_history[i], c, false, false);
    if (i && c.detection_history[i - 1].stamp_ns <= c.detection_history[i].stamp_ns)
      throw Invalid{};
  }
  if (!remote_tracks) check_list(c.tracks, c, false, true);
  if (!remote_trajectory) check_trajectory(c, false);
  try {
    if (remote_tracks) check_list(c.tracks, c, true, true);
    if (remote_trajectory) check_trajectory(c, true);
  } catch (const Invalid&) {
    return false;
  }
  return true;
}
