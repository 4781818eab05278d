# s_b = v^2 / (2 a_b) in doubles: relative error 2^-52 (1 + 2^-54), two roundings.
@rnd = float<ieee_64, ne>;
v = rnd(v_); a_b = rnd(a_b_);
s_b rnd= v * v / (2 * a_b);
exact = v * v / (2 * a_b);
{ v in [1e-100, 150] /\ a_b in [0.1, 100] -> |s_b -/ exact| <= BOUND }
