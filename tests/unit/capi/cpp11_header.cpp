// skerry_echo.h as a strict C++11 compiler sees it.
#include <skerry_echo.h>

uint32_t header_in_cpp() { return skerry_echo_version(); }
