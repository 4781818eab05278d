# s_follow in doubles from braking distances that are off by at most 4.6e-13 m: absolute error, m.
# Without the maximum with 0, which makes no error larger.
@rnd = float<ieee_64, ne>;
v_now = rnd(v_now_); safety_time = rnd(safety_time_);
s_b_now = rnd(s_b_now_); s_b_lead = rnd(s_b_lead_);
longer rnd= s_b_now - s_b_lead;
s_cav rnd= safety_time * v_now;
s_follow rnd= longer + s_cav;
exact = (exact_now - exact_lead) + safety_time * v_now;
{ v_now in [0, 70] /\ safety_time in [0, 2] /\ s_b_now in [0, 2450] /\ s_b_lead in [0, 2450]
  /\ |s_b_now - exact_now| <= 4.6e-13 /\ |s_b_lead - exact_lead| <= 4.6e-13
  -> |s_follow - exact| <= BOUND }
s_follow - exact -> (s_follow - (longer + s_cav)) + ((longer - (s_b_now - s_b_lead))
  + ((s_b_now - exact_now) - (s_b_lead - exact_lead)) + (s_cav - safety_time * v_now));
