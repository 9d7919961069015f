// skerry_echo.h as a strict C99 compiler sees it, twice, before anything else.
#include <skerry_echo.h>

uint32_t header_in_c(skerry_echo_position* place) {
  skerry_echo_style style;
  skerry_echo_chart* chart = NULL;
  place->latitude_deg = 0.0;
  place->longitude_deg = 0.0;
  if (skerry_echo_style_defaults(SKERRY_ECHO_COAST_ROCKY, &style, sizeof style) != SKERRY_ECHO_OK)
    return 0;
  if (skerry_echo_chart_destroy(chart) != SKERRY_ECHO_OK) return 0;
  return skerry_echo_version();
}
