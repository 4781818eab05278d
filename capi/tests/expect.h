/* For tests in C: names what does not hold and goes on. */
#ifndef EXPECT_H
#define EXPECT_H

#include <stdio.h>

static int failures;

#define EXPECT(condition)                                                    \
  do {                                                                       \
    if (!(condition)) {                                                      \
      printf("%s:%d: does not hold: %s\n", __FILE__, __LINE__, #condition);  \
      ++failures;                                                            \
    }                                                                        \
  } while (0)

/* What `main` returns. */
static int report_failures(void) {
  if (failures == 0) printf("all holds\n");
  return failures != 0;
}

#endif
