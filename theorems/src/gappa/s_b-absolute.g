# s_b = v^2 / (2 a_b) in doubles, at most 2450 m: absolute error, m.
@rnd = float<ieee_64, ne>;
v = rnd(v_); a_b = rnd(a_b_);
s_b rnd= v * v / (2 * a_b);
exact = v * v / (2 * a_b);
{ v in [0, 70] /\ a_b in [1, 12] -> |s_b - exact| <= BOUND }
