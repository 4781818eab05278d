// A program under test: the paper profile of MUFASA for Node.js, from the text of spec/. It answers
// the record `cycle`, one line each; record.mjs reads it, exact.mjs decides what doubles cannot.
//
// Every other comparison that could accept is made cautious by EPS: coordinates reach 2^24 m, where
// doubles are 2e-9 m apart, and spec/4-arithmetic.md lets a program reject within delta of a
// threshold.
import { createInterface } from "node:readline";

import { inTriangle } from "./exact.mjs";
import { Invalid, isValid, parse, readCycle } from "./record.mjs";

const EPS = 4e-9; // m; less than the smallest margin delta, 1e-8

const distance = (a, b) => Math.hypot(a.x - b.x, a.y - b.y);

// Stage i.

// The least sum of one entry per row, no column twice; not more rows than columns. Each row takes
// the column that costs least when those before it make room.
function leastSum(costs) {
  const rowOf = costs[0].map(() => -1);
  costs.forEach((row, start) => {
    const sum = [...row], from = row.map(() => -1);
    for (let changes = true, round = 0; changes && round < row.length; round += 1) {
      changes = false;
      for (const [c, r] of rowOf.entries()) {
        if (r < 0) continue;
        for (let d = 0; d < row.length; d += 1) {
          const moved = sum[c] - costs[r][c] + costs[r][d];
          if (moved < sum[d] - 1e-11) [sum[d], from[d], changes] = [moved, c, true];
        }
      }
    }
    let c = -1;
    sum.forEach((it, d) => { if (rowOf[d] < 0 && (c < 0 || it < sum[c])) c = d; });
    for (; c >= 0; c = from[c]) rowOf[c] = from[c] < 0 ? start : rowOf[from[c]];
  });
  return rowOf.reduce((sum, r, c) => (r < 0 ? sum : sum + costs[r][c]), 0);
}

function meanIsSmall(tracks, detections, { theta_tr, work_limit }) {
  const [rows, columns] = [tracks, detections].sort((a, b) => a.length - b.length);
  const k = rows.length;
  if (k === 0) return true;
  if (k * k * columns.length > Number(work_limit)) return false;
  // One pair that is so far apart is enough for the mean to be too large.
  const most = 2 * k * theta_tr;
  const costs = rows.map((a) => columns.map((b) => Math.min(distance(a, b), most)));
  return leastSum(costs) / k < theta_tr - EPS;
}

function stageI({ ego, tracks, detections, parameters }) {
  const r = Math.max(0, ...detections.items.map((it) => distance(it, ego)));
  let choices = [[]];
  for (const track of tracks.items) {
    const beyond = distance(track, ego) - r;
    if (beyond < -EPS) choices.forEach((choice) => choice.push(track));
    // At the border of what is seen rounding decides: with the track and without it.
    else if (beyond <= EPS) choices = choices.flatMap((it) => [it, [...it, track]]);
    if (choices.length > 2 ** 6) return false;
  }
  return choices.every((choice) => meanIsSmall(choice, detections.items, parameters));
}

// Stage ii.

function segments({ stations, closed }) {
  const pairs = stations.slice(1).map((next, i) => [stations[i], next]);
  if (closed) pairs.push([stations.at(-1), stations[0]]);
  return pairs;
}

function distanceToSegment(p, [a, b]) {
  const [dx, dy, px, py] = [b.x - a.x, b.y - a.y, p.x - a.x, p.y - a.y];
  const along = px * dx + py * dy, square = dx * dx + dy * dy;
  if (along <= 0 || along >= square) return Math.min(distance(p, a), distance(p, b));
  return Math.abs(px * dy - py * dx) / Math.sqrt(square);
}

function inCorridor(p, pairs) {
  return pairs.some(([a, b]) => inTriangle([p.x, p.y], [a.left, a.right, b.right])
    || inTriangle([p.x, p.y], [a.left, b.right, b.left]));
}

function stageII({ trajectory, route, parameters }) {
  const pairs = segments(route);
  const isNear = (p) => pairs.some((it) => distanceToSegment(p, it) <= parameters.theta_map - EPS);
  return trajectory.points.every((p) => isNear(p) || inCorridor(p, pairs));
}

// Stages iii and iv.

const brakingDistance = ({ parameters }, v) => (v * v) / (2 * parameters.a_b);
const sCav = ({ parameters, ego }) => parameters.safety_time * ego.speed;
const seconds = (ns) => Number(ns) / 1e9;

function pointsWithin({ trajectory: { points } }, horizon) {
  let arc = 0;
  const end = points.findIndex((p, i) => {
    arc += i > 0 ? distance(points[i - 1], p) : 0;
    return arc > horizon + EPS;
  });
  return end < 0 ? points : points.slice(0, end);
}

// Whether the CAV at a pose meets an object that has moved by (mx, my).
function collides({ ego, parameters }, pose, item, mx = 0, my = 0) {
  const x = item.x - pose.x + mx - ego.center_offset * pose.cos;
  const y = item.y - pose.y + my - ego.center_offset * pose.sin;
  if (!(Math.hypot(x, y) < parameters.theta_obj + EPS)) return false;
  // Half sides as vectors; the axes that could part the rectangles are their directions.
  const sides = [[pose, ego, EPS], [item, item, 0]].flatMap(([{ cos, sin }, box, more]) => [
    [cos, sin, box.length / 2 + more],
    [-sin, cos, box.width / 2 + more],
  ]);
  return sides.every(([ax, ay]) => {
    const reach = sides.map(([bx, by, half]) => half * Math.abs(ax * bx + ay * by));
    return Math.abs(ax * x + ay * y) <= reach.reduce((a, b) => a + b);
  });
}

function stageIII(cycle) {
  const { stamp_ns, items } = cycle.tracks;
  return pointsWithin(cycle, sCav(cycle)).every((point) => {
    const t = seconds(point.t_ns - stamp_ns);
    return !items.some((it) => collides(cycle, point, it, it.vx * t, it.vy * t));
  });
}

function stageIV(cycle) {
  const { ego, lead, detections } = cycle;
  let horizon = brakingDistance(cycle, ego.speed);
  if (lead) {
    horizon = Math.max(horizon - brakingDistance(cycle, lead.speed), 0) + sCav(cycle);
    if (lead.gap <= horizon + EPS) return false;
  }
  return pointsWithin(cycle, horizon).every(
    (point) => !detections.items.some((it) => collides(cycle, point, it)));
}

// Stage v.

function occupiedCells({ occupied, width, height }) {
  const cells = [];
  occupied.forEach((byte, at) => {
    for (let bit = 0; byte >> bit > 0; bit += 1) {
      const index = 8 * at + bit;
      if ((byte >> bit) & 1 && index < width * height) {
        cells.push([index % width, Math.floor(index / width)]);
      }
    }
  });
  return cells;
}

function stageV(cycle) {
  const { grid, ego, parameters } = cycle;
  const cells = occupiedCells(grid), n = Number(parameters.n);
  const r = Math.hypot(ego.length / n, ego.width) / 2 + EPS;
  const isMarked = (i, k) => i >= 0 && i < grid.width && k >= 0 && k < grid.height
    && cells.some(([a, b]) => Math.hypot(a - i, b - k) * grid.resolution <= r);
  const square = grid.cos ** 2 + grid.sin ** 2;
  const known = new Map();
  for (const point of pointsWithin(cycle, brakingDistance(cycle, ego.speed))) {
    for (let disk = 0; disk < n; disk += 1) {
      const along = ((2 * disk + 1 - n) * ego.length) / (2 * n) + ego.center_offset;
      const x = point.x - grid.x + along * point.cos, y = point.y - grid.y + along * point.sin;
      const u = (x * grid.cos + y * grid.sin) / square, v = (y * grid.cos - x * grid.sin) / square;
      // A centre at the border of cells lies in each of them.
      for (const [du, dv] of [[-EPS, -EPS], [EPS, -EPS], [-EPS, EPS], [EPS, EPS]]) {
        const cell = [u + du, v + dv].map((it) => Math.floor(it / grid.resolution));
        const name = cell.join();
        if (!known.has(name)) known.set(name, isMarked(...cell));
        if (known.get(name)) return false;
      }
    }
  }
  return true;
}

// The first stage that fails, in the order of spec/3-stages.md#schedule; null when none does.
function failedStage(cycle) {
  if (!isValid(cycle)) return "input";
  const { configuration, now_ns, parameters } = cycle;
  if (configuration === "Local") return null;
  const isCurrent = (input) => input !== null && now_ns - input.stamp_ns >= 0n
    && now_ns - input.stamp_ns <= parameters.max_age_ns;
  const detections = isCurrent(cycle.detections);
  if (!isCurrent(cycle.lead)) cycle.lead = null;
  // Received tracks are judged whatever their age.
  const received = configuration !== "PlanRemote" && cycle.tracks;
  if (received && detections && !stageI(cycle)) return "i";
  if (!isCurrent(cycle.trajectory)) return null;
  if (!stageII(cycle)) return "ii";
  const ranIII = configuration !== "MotRemote" && isCurrent(cycle.tracks);
  if (ranIII && !stageIII(cycle)) return "iii";
  const runsIV = detections && !ranIII;
  if (runsIV && !stageIV(cycle)) return "iv";
  const runsV = configuration === "MotRemote"
    || (configuration === "AllRemote" && !ranIII && !runsIV);
  return runsV && isCurrent(cycle.grid) && !stageV(cycle) ? "v" : null;
}

function answer(line) {
  const record = parse(line);
  try {
    const stage = failedStage(readCycle(record));
    return { id: record.id, verdict: stage ? "unsafe" : "safe", failed_stage: stage };
  } catch (error) {
    if (!(error instanceof Invalid)) throw error;
    return { id: record.id, verdict: "error", failed_stage: null };
  }
}

for await (const line of createInterface({ input: process.stdin })) {
  process.stdout.write(`${JSON.stringify(answer(line))}\n`);
}
