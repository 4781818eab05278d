/* Gives the imports of a compiled harness their meaning for CBMC and calls it. Its memory is in h.c,
   edited by scripts/prove-wasm.
   HARNESS: the exported function.
   TWIN: instead of the proof, claim that no cover (covers.h has one case for each) and not even
   the end of the harness is ever reached. All of these claims must fail. */
#include <string.h>
#include "h.h"

#define JOIN(a, b) a##b
#define CALL(name) JOIN(w2c_h_, name)

uint64_t nondet_u64(void);
double nondet_f64(void);

struct w2c_env { int unused; };

u64 w2c_env_any_u64(struct w2c_env *env) { return nondet_u64(); }
u32 w2c_env_any_below(struct w2c_env *env, u32 limit) {
  u32 value = nondet_u64();
  __CPROVER_assume(value < limit);
  return value;
}
f64 w2c_env_any_f64(struct w2c_env *env) { return nondet_f64(); }
void w2c_env_assume_that(struct w2c_env *env, u32 condition) { __CPROVER_assume(condition); }

void w2c_env_cover_that(struct w2c_env *env, u32 name, u32 condition) {
#ifdef TWIN
  switch (name) {
#include "covers.h"
  }
#endif
}

/* Panics, failed assertions, arithmetic overflow. What comes behind a trap does not matter any more;
   to end the path here would cost a condition in all that follows. A twin speaks of covers that are
   reached without a trap, which the proof has shown never to happen. */
void wasm_rt_trap(wasm_rt_trap_t code) {
#ifndef TWIN
  __CPROVER_assert(0, "trap");
#endif
}

bool wasm_rt_is_initialized(void) { return 1; }
uint32_t wasm_rt_call_stack_depth = 0;

void wasm_rt_allocate_memory(wasm_rt_memory_t *it, uint64_t first, uint64_t most, bool is64) {
  it->data = 0;
  it->pages = first;
  it->size = 0;
}

void wasm_rt_allocate_funcref_table(wasm_rt_funcref_table_t *it, uint32_t count, uint32_t most) {
  static wasm_rt_funcref_t table[32];
  __CPROVER_assert(count <= 32, "the table of functions fits");
  it->data = table;
  it->size = count;
  it->max_size = most;
}

static w2c_h instance;
static struct w2c_env env;

int main(void) {
  wasm2c_h_instantiate(&instance, &env);
  CALL(HARNESS)(&instance);
#ifdef TWIN
  __CPROVER_assert(0, "end");
#endif
  return 0;
}
