#pragma once

#include <cstdio>
#include <cstdlib>

/// Programmer mistakes. On in debug, test and sanitizer builds (CELADON_ASSERTIONS).
#ifdef CELADON_ASSERTIONS
#define CELADON_ASSERT(condition)                                                                  \
    ((condition)                                                                                   \
         ? static_cast<void>(0)                                                                    \
         : (std::fprintf(stderr, "%s:%d: assertion failed: %s\n", __FILE__, __LINE__, #condition), \
            std::abort()))
#else
#define CELADON_ASSERT(condition) static_cast<void>(0)
#endif
