// Reads the record `cycle` (spec/5-interfaces.md#cycle) and checks the domain of its values
// (spec/3-stages.md#invalid-input, spec/4-arithmetic.md#domain). That the line keeps the schema is
// taken for granted: `mufasa conform --kinds cycle` sends no other.
import { isDirection } from "./exact.mjs";

const MINUTE = 60_000_000_000n;
const LAST = 2n ** 63n - 1n;

export class Invalid extends Error {}

const POSITION = [-(2 ** 24), 2 ** 24], SPEED = [0, 150], VELOCITY = [-150, 150], SIZE = [0.01, 100];
const THRESHOLD = [1e-3, 1e3], SECONDS = [0, 60], RATE = [0.1, 100], ABOVE_ZERO = [5e-324, 1e3];
const BOX = { x: POSITION, y: POSITION, length: SIZE, width: SIZE };

// Name: default and domain. What is a BigInt is read as one.
const PARAMETERS = {
  theta_tr: [0.2, THRESHOLD], theta_map: [0.3, THRESHOLD], theta_obj: [5, THRESHOLD],
  a_b: [8, RATE], safety_time: [1.8, SECONDS], max_age_ns: [100_000_000n, [0n, MINUTE]],
  n: [4n, [1n, 64n]], work_limit: [700_000n, [0n, LAST]], delta: [1e-6, [1e-8, 1e-2]],
  theta_track_max: [1, THRESHOLD], miss_budget: [4n, [0n, 64n]], tau: [0.1, SECONDS],
  a_max: [3, RATE], start_tolerance: [2, THRESHOLD], v_max: [150, ABOVE_ZERO],
  step_max_ns: [200_000_000n, [0n, MINUTE]], theta_velocity: [2, ABOVE_ZERO],
  lateral_tolerance: [0.5, THRESHOLD], v_object: [70, ABOVE_ZERO], t_yield: [2, SECONDS],
  a_yield: [3, RATE],
};

// JSON.parse makes doubles of all numbers: integers that none can hold become strings before.
export function parse(line) {
  const tokens = /"(?:[^"\\]|\\.)*"|-?\d[\d.eE+-]*/g;
  return JSON.parse(line.replace(tokens, (it) => (/^-?\d{16,}$/.test(it) ? `"${it}"` : it)));
}

// "nan", "inf" and "-inf" become NaN: none is a value. Integers become BigInts where they are asked for.
function convert(value, key) {
  if (Array.isArray(value)) return value.map((it) => convert(it, key));
  if (value && typeof value === "object") {
    return Object.fromEntries(Object.entries(value).map(([k, it]) => [k, convert(it, k)]));
  }
  const isText = ["kind", "id", "profile", "configuration", "occupied", "unknown"].includes(key);
  if (isText && typeof value === "string") return value;
  const isInteger = key.endsWith("_ns") || ["n", "work_limit", "miss_budget", "id"].includes(key);
  if (isInteger) return BigInt(value);
  return typeof value === "string" ? Number(value) : value;
}

// A cycle with its defaults; missing inputs are null.
export function readCycle(record) {
  const cycle = convert(record, "");
  for (const key of ["trajectory", "tracks", "detections", "lead", "grid"]) cycle[key] ??= null;
  cycle.detection_history ??= [];
  cycle.parameters ??= {};
  for (const [key, [value]] of Object.entries(PARAMETERS)) cycle.parameters[key] ??= value;
  if (cycle.grid) {
    for (const key of ["occupied", "unknown"]) {
      const text = cycle.grid[key] ?? null;
      cycle.grid[key] = text === null ? null : Buffer.from(text, "base64");
    }
  }
  return cycle;
}

function within(value, [least, most]) {
  if (!(value >= least && value <= most)) throw new Invalid();
}

function checkItem(item, domains) {
  for (const [key, domain] of Object.entries(domains)) within(item[key], domain);
  if (!("cos" in item)) return;
  within(item.cos, [-2, 2]);
  within(item.sin, [-2, 2]);
  if (!isDirection(item.cos, item.sin, 1e-6)) throw new Invalid();
}

// Nothing is from more than a minute ahead; only what is local may be older.
function checkTime(time, cycle, mayBeOld) {
  const age = cycle.now_ns - time;
  if (age < -MINUTE || (age > MINUTE && !mayBeOld)) throw new Invalid();
}

function checkList(list, cycle, isRemote, most, domains) {
  if (!list) return;
  checkTime(list.stamp_ns, cycle, !isRemote);
  within(list.items.length, [0, most]);
  for (const item of list.items) checkItem(item, domains);
}

function checkTracks(cycle, isRemote) {
  const domains = { ...BOX, vx: VELOCITY, vy: VELOCITY };
  checkList(cycle.tracks, cycle, isRemote, 1024, domains);
  const items = cycle.tracks?.items ?? [];
  if (new Set(items.map((it) => it.id)).size < items.length) throw new Invalid();
}

function checkTrajectory(cycle, isRemote) {
  if (!cycle.trajectory) return;
  const { stamp_ns, points } = cycle.trajectory;
  checkTime(stamp_ns, cycle, !isRemote);
  within(points.length, [1, 1024]);
  const isOld = cycle.now_ns - stamp_ns > MINUTE;
  points.forEach((point, i) => {
    checkTime(point.t_ns, cycle, isOld);
    checkItem(point, { x: POSITION, y: POSITION });
    if (i > 0 && points[i - 1].t_ns >= point.t_ns) throw new Invalid();
  });
}

function checkRoute({ stations }) {
  within(stations.length, [2, 8192]);
  stations.forEach(({ x, y, left, right }, i) => {
    for (const value of [x, y, ...left, ...right]) within(value, POSITION);
    if (i > 0 && stations[i - 1].x === x && stations[i - 1].y === y) throw new Invalid();
  });
}

function checkGrid(grid) {
  checkItem(grid, { x: POSITION, y: POSITION, resolution: [0.01, 10] });
  for (const side of [grid.width, grid.height]) within(side, [1, 2 ** 15]);
  within(grid.width * grid.height, [1, 2 ** 24]);
  for (const bitmap of [grid.occupied, grid.unknown]) {
    if (bitmap !== null && bitmap.length !== Math.ceil((grid.width * grid.height) / 8)) throw new Invalid();
  }
}

function checkLocal(cycle) {
  const domains = Object.entries(PARAMETERS).map(([key, [, domain]]) => [key, domain]);
  checkItem(cycle.parameters, Object.fromEntries(domains));
  checkItem(cycle.ego, { ...BOX, speed: SPEED, center_offset: [-100, 100] });
  if (cycle.lead) {
    checkTime(cycle.lead.stamp_ns, cycle, true);
    checkItem(cycle.lead, { gap: [0, 1e6], speed: SPEED });
  }
  checkRoute(cycle.route);
  if (cycle.grid) {
    checkTime(cycle.grid.stamp_ns, cycle, true);
    checkGrid(cycle.grid);
  }
  checkList(cycle.detections, cycle, false, 2048, BOX);
  const history = cycle.detection_history;
  within(history.length, [0, 4]);
  history.forEach((list, i) => {
    checkList(list, cycle, false, 2048, BOX);
    if (i > 0 && history[i - 1].stamp_ns <= list.stamp_ns) throw new Invalid();
  });
}

// Throws Invalid for local data; returns whether what is remote is valid.
export function isValid(cycle) {
  checkLocal(cycle);
  const all = cycle.configuration === "AllRemote";
  const checks = [[checkTracks, all || cycle.configuration === "MotRemote"],
    [checkTrajectory, all || cycle.configuration === "PlanRemote"]];
  for (const [check, isRemote] of checks) if (!isRemote) check(cycle, false);
  try {
    for (const [check, isRemote] of checks) if (isRemote) check(cycle, true);
  } catch (error) {
    if (error instanceof Invalid) return false;
    throw error;
  }
  return true;
}
