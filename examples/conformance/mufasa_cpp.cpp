// A program under test: the paper profile of MUFASA in doubles (the norm of directions
// exactly), from the text of spec/ alone.
//
// It answers the record `cycle` of spec/5-interfaces.md (read by json.hpp and record.hpp), one line
// each. It is no part of the project: it shows how little a program needs to be judged by
// `mufasa conform`.
//
// Every comparison that could accept is made cautious by kEps: coordinates reach 2^24 m, where
// doubles are 2e-9 m apart, and spec/4-arithmetic.md lets a program reject within delta of a
// threshold.
#include <array>
#include <iostream>
#include <map>

#include "record.hpp"

namespace {

constexpr double kEps = 4e-9;  // m; above what rounding did so far, below the smallest delta (1e-8)

double distance(const Point& a, const Point& b) { return std::hypot(a.x - b.x, a.y - b.y); }

// Stage i.

using Costs = std::vector<std::vector<double>>;

// The least sum of one entry per row, no column twice; not more rows than columns.
double assignment_cost(const Costs& costs) {
  const std::size_t columns = costs[0].size(), none = costs.size();
  std::vector<std::size_t> row_of(columns + 1, none), before(columns);
  std::vector<double> u(costs.size()), v(columns + 1);
  for (std::size_t start = 0; start < costs.size(); ++start) {
    std::vector<double> shortest(columns, HUGE_VAL);
    std::vector<bool> done(columns + 1);
    std::size_t j = columns;
    row_of[j] = start;
    while (row_of[j] != none) {
      done[j] = true;
      std::size_t i = row_of[j], best = columns;
      for (std::size_t k = 0; k < columns; ++k) {
        if (done[k]) continue;
        double cost = costs[i][k] - u[i] - v[k];
        if (cost < shortest[k]) shortest[k] = cost, before[k] = j;
        if (best == columns || shortest[k] < shortest[best]) best = k;
      }
      double step = shortest[best];
      for (std::size_t k = 0; k <= columns; ++k) {
        if (done[k]) u[row_of[k]] += step, v[k] -= step;
        else if (k < columns) shortest[k] -= step;
      }
      j = best;
    }
    for (; j != columns; j = before[j]) row_of[j] = row_of[before[j]];
  }
  double sum = 0;
  for (std::size_t k = 0; k < columns; ++k)
    if (row_of[k] != none) sum += costs[row_of[k]][k];
  return sum;
}

bool mean_is_small(const Cycle& c, std::vector<Object> rows, std::vector<Object> columns) {
  if (rows.size() > columns.size()) std::swap(rows, columns);
  if (rows.empty()) return true;
  double few = double(rows.size()), many = double(columns.size());
  if (few * few * many > double(c.parameters.work_limit)) return false;
  Costs costs;
  for (auto& a : rows) {
    costs.emplace_back();
    for (auto& b : columns) costs.back().push_back(distance(a, b));
  }
  return assignment_cost(costs) / double(rows.size()) < c.parameters.theta_tr - kEps;
}

// A track so near the border of the field of view that rounding decides is tried both ways.
bool stage_i(const Cycle& c) {
  double r = 0;
  for (auto& item : c.detections->items) r = std::max(r, distance(item, c.ego));
  std::vector<Object> inside, border;
  for (auto& item : c.tracks->items) {
    double d = distance(item, c.ego);
    if (d < r - kEps) inside.push_back(item);
    else if (d <= r + kEps) border.push_back(item);
  }
  if (border.size() > 6) return false;
  for (unsigned some = 0; some < 1u << border.size(); ++some) {
    auto gated = inside;
    for (std::size_t i = 0; i < border.size(); ++i)
      if (some >> i & 1) gated.push_back(border[i]);
    if (!mean_is_small(c, gated, c.detections->items)) return false;
  }
  return true;
}

// Stage ii.

using Polygon = std::vector<Point>;
using Pairs = std::vector<std::pair<Station, Station>>;

double segment_distance(const Point& p, const Point& a, const Point& b) {
  double ax = a.x - p.x, ay = a.y - p.y, dx = b.x - a.x, dy = b.y - a.y;
  double square = dx * dx + dy * dy, along = -(ax * dx + ay * dy);
  if (0 < along && along < square) return std::fabs(ax * dy - ay * dx) / std::sqrt(square);
  return std::min(distance(p, a), distance(p, b));
}

double cross(const Point& a, const Point& b, const Point& p) {
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

// The parts of a convex polygon to the left and to the right of the line from a to b.
std::array<Polygon, 2> clip(const Polygon& polygon, const Point& a, const Point& b) {
  std::array<Polygon, 2> parts;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point &p = polygon[i], &q = polygon[(i ? i : polygon.size()) - 1];
    double s = cross(a, b, p), t = cross(a, b, q);
    if ((s > 0 && t < 0) || (s < 0 && t > 0)) {
      double cut = t / (t - s);
      for (auto& part : parts) part.push_back({q.x + cut * (p.x - q.x), q.y + cut * (p.y - q.y)});
    }
    if (s >= 0) parts[0].push_back(p);
    if (s <= 0) parts[1].push_back(p);
  }
  return parts;
}

double area(const Polygon& polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point &p = polygon[i], &q = polygon[(i ? i : polygon.size()) - 1];
    twice += q.x * p.y - q.y * p.x;
  }
  return std::fabs(twice) / 2;
}

// What a triangle leaves of the pieces.
std::vector<Polygon> without(const std::vector<Polygon>& pieces, Point a, Point b, Point c) {
  double turn = cross(a, b, c);
  if (turn == 0) return pieces;
  if (turn < 0) std::swap(b, c);
  std::vector<Polygon> rest;
  for (auto piece : pieces) {
    for (auto& [start, end] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
      auto parts = clip(piece, start, end);
      piece = parts[0];
      if (parts[1].size() > 2) rest.push_back(parts[1]);
    }
  }
  return rest;
}

// Whether the triangles cover a small square around p, so that rounding opens no gap.
bool in_corridor(const Point& p, const Pairs& pairs) {
  std::vector<Polygon> rest{{{-kEps, -kEps}, {kEps, -kEps}, {kEps, kEps}, {-kEps, kEps}}};
  for (auto& [first, second] : pairs) {
    Point quad[] = {first.left, first.right, second.right, second.left};
    double left = HUGE_VAL, right = -HUGE_VAL, low = HUGE_VAL, high = -HUGE_VAL;
    for (auto& corner : quad) {
      corner = {corner.x - p.x, corner.y - p.y};
      left = std::min(left, corner.x), right = std::max(right, corner.x);
      low = std::min(low, corner.y), high = std::max(high, corner.y);
    }
    if (left > kEps || right < -kEps || low > kEps || high < -kEps) continue;
    rest = without(rest, quad[0], quad[1], quad[2]);
    rest = without(rest, quad[0], quad[2], quad[3]);
  }
  double uncovered = 0;
  for (auto& piece : rest) uncovered += area(piece);
  return uncovered < 0.01 * kEps * kEps;
}

bool stage_ii(const Cycle& c) {
  Pairs pairs;
  for (std::size_t i = 0; i + 1 < c.stations.size(); ++i)
    pairs.emplace_back(c.stations[i], c.stations[i + 1]);
  if (c.closed) pairs.emplace_back(c.stations.back(), c.stations.front());
  return std::all_of(c.trajectory->items.begin(), c.trajectory->items.end(), [&](auto& p) {
    return in_corridor(p, pairs) || std::any_of(pairs.begin(), pairs.end(), [&](auto& pair) {
      return segment_distance(p, pair.first, pair.second) <= c.parameters.theta_map - kEps;
    });
  });
}

// Stages iii and iv.

std::vector<TrajectoryPoint> points_within(const Cycle& c, double horizon) {
  std::vector<TrajectoryPoint> result;
  double arc = 0;
  for (auto& point : c.trajectory->items) {
    if (!result.empty()) arc += distance(result.back(), point);
    if (arc > horizon + kEps) break;
    result.push_back(point);
  }
  return result;
}

// The low-level collision check with an object that has moved by (dx, dy).
bool collides(const Cycle& c, const TrajectoryPoint& point, const Object& item, double dx,
              double dy) {
  const Ego& ego = c.ego;
  dx += (item.x - point.x) - ego.center_offset * point.cos;
  dy += (item.y - point.y) - ego.center_offset * point.sin;
  if (!(std::hypot(dx, dy) < c.parameters.theta_obj + kEps)) return false;
  struct Edge { double x, y, half; };
  const Edge edges[] = {{point.cos, point.sin, ego.length / 2 + kEps},
                        {-point.sin, point.cos, ego.width / 2 + kEps},
                        {item.cos, item.sin, item.length / 2},
                        {-item.sin, item.cos, item.width / 2}};
  return std::all_of(std::begin(edges), std::end(edges), [&](const Edge& axis) {
    double reach = 0;
    for (auto& edge : edges) reach += edge.half * std::fabs(edge.x * axis.x + edge.y * axis.y);
    return std::fabs(dx * axis.x + dy * axis.y) <= reach;
  });
}

double s_b(const Cycle& c, double v) { return v * v / (2 * c.parameters.a_b); }
double s_cav(const Cycle& c) { return c.parameters.safety_time * c.ego.speed; }

bool stage_iii(const Cycle& c) {
  for (auto& point : points_within(c, s_cav(c))) {
    double t = double(point.t_ns - c.tracks->stamp_ns) / 1e9;
    for (auto& item : c.tracks->items)
      if (collides(c, point, item, item.vx * t, item.vy * t)) return false;
  }
  return true;
}

bool stage_iv(const Cycle& c) {
  double horizon = s_b(c, c.ego.speed);
  if (c.lead) {
    horizon = std::max(horizon - s_b(c, c.lead->speed), 0.0) + s_cav(c);
    if (c.lead->gap <= horizon + kEps) return false;
  }
  for (auto& point : points_within(c, horizon))
    for (auto& item : c.detections->items)
      if (collides(c, point, item, 0, 0)) return false;
  return true;
}

// Stage v.

// Whether an occupied cell is within r of this one, centre to centre.
bool marked(const Grid& g, std::int64_t column, std::int64_t row, double r) {
  auto reach = std::int64_t(r / g.resolution);
  for (auto k = std::max<std::int64_t>(row - reach, 0); k <= row + reach && k < g.height; ++k) {
    double across = double(k - row) * g.resolution;
    auto side = std::int64_t(std::sqrt(std::max(r * r - across * across, 0.0)) / g.resolution);
    auto last = std::min(column + side, g.width - 1);
    for (auto i = std::max<std::int64_t>(column - side, 0); i <= last; ++i) {
      auto bit = std::size_t(k * g.width + i);
      if (g.occupied[bit / 8] >> (bit % 8) & 1) return true;
    }
  }
  return false;
}

bool stage_v(const Cycle& c) {
  const Grid& g = *c.grid;
  double n = double(c.parameters.n), length = c.ego.length, width = c.ego.width;
  double r = std::sqrt(length / n * (length / n) + width * width) / 2 + kEps;
  double norm = g.cos * g.cos + g.sin * g.sin;
  std::map<std::pair<double, double>, bool> known;
  for (auto& point : points_within(c, s_b(c, c.ego.speed))) {
    for (double i = 0; i < n; ++i) {
      double along = (2 * i + 1) * length / (2 * n) - length / 2 + c.ego.center_offset;
      double x = (point.x - g.x) + along * point.cos, y = (point.y - g.y) + along * point.sin;
      double u = (x * g.cos + y * g.sin) / norm, v = (y * g.cos - x * g.sin) / norm;
      // A centre on the border of cells lies in each of them.
      for (auto& [a, b] : {std::pair(-1, -1), std::pair(1, -1), std::pair(-1, 1), std::pair(1, 1)}) {
        double column = std::floor((u + a * kEps) / g.resolution);
        double row = std::floor((v + b * kEps) / g.resolution);
        bool inside = 0 <= column && column < double(g.width) && 0 <= row && row < double(g.height);
        if (!inside) continue;
        auto [entry, is_new] = known.try_emplace({column, row}, false);
        if (is_new) entry->second = marked(g, std::int64_t(column), std::int64_t(row), r);
        if (entry->second) return false;
      }
    }
  }
  return true;
}

// The first stage that fails, in the order of spec/3-stages.md#schedule; empty when none does.
std::string failed_stage(Cycle c) {
  if (!check_input(c)) return "input";
  if (c.configuration == "Local") return "";
  auto current = [&](auto& input) {
    if (!input) return false;
    std::int64_t age_ns = elapsed_ns(input->stamp_ns, c.now_ns);
    return 0 <= age_ns && age_ns <= c.parameters.max_age_ns;
  };
  bool detections = current(c.detections);
  if (!current(c.lead)) c.lead.reset();
  if (c.configuration != "PlanRemote" && c.tracks && detections && !stage_i(c)) return "i";
  if (!current(c.trajectory)) return "";
  if (!stage_ii(c)) return "ii";
  bool ran_iii = current(c.tracks) && c.configuration != "MotRemote";
  if (ran_iii && !stage_iii(c)) return "iii";
  bool ran_iv = detections && !ran_iii;
  if (ran_iv && !stage_iv(c)) return "iv";
  bool always = c.configuration == "MotRemote";
  bool run_v = always || (c.configuration == "AllRemote" && !ran_iii && !ran_iv);
  return run_v && current(c.grid) && !stage_v(c) ? "v" : "";
}

std::string answer(const std::string& line) {
  std::string id = "null";
  try {
    Value record = Reader(line).document();
    const Value& name = record.at("id");
    name.as_string();
    id = name.raw;
    if (record.at("kind").as_string() != "cycle") throw Broken{};
    std::string stage = failed_stage(read_cycle(record));
    if (stage.empty()) return "{\"id\":" + id + ",\"verdict\":\"safe\",\"failed_stage\":null}";
    return "{\"id\":" + id + ",\"verdict\":\"unsafe\",\"failed_stage\":\"" + stage + "\"}";
  } catch (const Broken&) {
  } catch (const Invalid&) {
  }
  return "{\"id\":" + id + ",\"verdict\":\"error\",\"failed_stage\":null}";
}

}  // namespace

int main() {
  std::ios::sync_with_stdio(false);
  for (std::string line; std::getline(std::cin, line);) std::cout << answer(line) << std::endl;
}
