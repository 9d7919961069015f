// Renders one turn of a radar and draws it as a grey picture (PGM), as a simulator would: a new
// scene for every sector of 64 spokes, because the ship sails while the antenna turns.
//
//   ppi out.pgm [latitude longitude range_nm [chart files ...]]
//
// Without a place the sound off Bergen.  Charts: GSHHG, ENC cells, GeoJSON or Shapefiles.
#include <math.h>
#include <skerry_echo.h>
#include <stdio.h>
#include <stdlib.h>

enum { SPOKES = 2048, CELLS = 512, SECTOR = 64, SIDE = 800 };

static uint8_t video[SPOKES][CELLS];
static uint8_t picture[SIDE][SIDE];

static void must(int32_t result, const char* what) {
  if (result == SKERRY_ECHO_OK) return;
  fprintf(stderr, "ppi: %s: %s: %s\n", what, skerry_echo_result_name(result),
          skerry_echo_last_error());
  exit(1);
}

// North up: spoke 0 points over the bow.
static void draw(double heading_deg) {
  const double pi = 3.14159265358979323846;
  for (int y = 0; y < SIDE; ++y) {
    for (int x = 0; x < SIDE; ++x) {
      const double east = x + 0.5 - SIDE / 2.0, north = SIDE / 2.0 - (y + 0.5);
      const double cell = sqrt(east * east + north * north) * CELLS / (SIDE / 2.0);
      double turns = atan2(east, north) / (2.0 * pi) - heading_deg / 360.0;
      turns -= floor(turns);
      if (cell < CELLS) picture[y][x] = video[(int)(turns * SPOKES + 0.5) % SPOKES][(int)cell];
    }
  }
}

int main(int argc, char** argv) {
  if (argc < 2 || argc == 3 || argc == 4) {
    fprintf(stderr, "usage: ppi out.pgm [latitude longitude range_nm [chart files ...]]\n");
    return 2;
  }
  const double latitude = argc > 4 ? atof(argv[2]) : 60.27;
  const double longitude = argc > 4 ? atof(argv[3]) : 5.15;
  const double range_nm = argc > 4 ? atof(argv[4]) : 6.0;
  // Each over those after it; "" is the finest GSHHG shoreline installed.
  const char* const world[] = {""};
  const char* const* charts = argc > 5 ? (const char* const*)(argv + 5) : world;
  const size_t chart_count = argc > 5 ? (size_t)(argc - 5) : 1;

  skerry_echo_chart* chart = NULL;
  skerry_echo_coast* coast = NULL;
  skerry_echo_radar* radar = NULL;
  must(skerry_echo_chart_open(charts, chart_count, NULL, 0, &chart), "chart");
  char warnings[2000];
  size_t size;
  if (skerry_echo_chart_warnings(chart, warnings, sizeof warnings, &size) == SKERRY_ECHO_OK &&
      size > 1) {
    fprintf(stderr, "ppi: %s\n", warnings);
  }
  must(skerry_echo_coast_create(chart, 1, &coast), "coast");

  // Rocky coast by fractional Brownian motion instead of the random Koch curve.
  skerry_echo_style style;
  must(skerry_echo_style_defaults(SKERRY_ECHO_COAST_ROCKY, &style, sizeof style), "style");
  style.method = SKERRY_ECHO_METHOD_MIDPOINT;
  style.dimension = 1.3;
  must(skerry_echo_coast_set_style(coast, SKERRY_ECHO_COAST_ROCKY, &style), "style");

  skerry_echo_radar_options options;
  must(skerry_echo_radar_defaults(&options, sizeof options), "radar");
  options.spokes_per_turn = SPOKES;
  options.cells = CELLS;
  must(skerry_echo_radar_create(coast, &options, &radar), "radar");
  must(skerry_echo_radar_set_controls(radar, range_nm, 50.0, 20.0, 0.0), "controls");

  skerry_echo_own_ship own;
  must(skerry_echo_own_ship_defaults(&own, sizeof own), "own ship");
  own.latitude_deg = latitude;
  own.longitude_deg = longitude;
  own.course_deg = own.heading_deg = 20.0;
  own.speed_mps = 6.0;

  // A ship a third of the range ahead of her, crossing.
  skerry_echo_target ship;
  must(skerry_echo_target_defaults(&ship, sizeof ship), "target");
  ship.identity = 1;
  ship.latitude_deg = latitude + range_nm / 180.0;
  ship.longitude_deg = longitude;
  ship.course_deg = ship.heading_deg = 270.0;
  ship.speed_mps = 7.0;
  ship.length_m = 120.0;

  for (uint64_t first = 0; first < SPOKES; first += SECTOR) {
    int64_t time_ns = 0;
    must(skerry_echo_radar_spoke_time(radar, first, &time_ns), "time");
    // Metres made good in this time; a simulator has its own ship's track instead.
    const double sailed = own.speed_mps * (double)time_ns * 1e-9;
    skerry_echo_own_ship now = own;
    now.latitude_deg += sailed * cos(own.course_deg / 57.295779513) / 111120.0;
    now.longitude_deg +=
        sailed * sin(own.course_deg / 57.295779513) / (111120.0 * cos(latitude / 57.295779513));
    skerry_echo_target there = ship;
    there.longitude_deg -=
        ship.speed_mps * (double)time_ns * 1e-9 / (111120.0 * cos(latitude / 57.295779513));
    must(skerry_echo_radar_set_scene(radar, time_ns, &now, &there, 1), "scene");
    must(skerry_echo_radar_render(radar, first, SECTOR, video[first],
                                  sizeof(uint8_t[SECTOR][CELLS]), CELLS),
         "render");
  }

  draw(own.heading_deg);
  FILE* file = fopen(argv[1], "wb");
  if (!file) {
    perror(argv[1]);
    return 1;
  }
  fprintf(file, "P5\n%d %d\n255\n", SIDE, SIDE);
  const size_t written = fwrite(picture, 1, sizeof picture, file);
  if (fclose(file) != 0 || written != sizeof picture) {
    perror(argv[1]);
    return 1;
  }
  must(skerry_echo_radar_destroy(radar), "radar");
  must(skerry_echo_coast_destroy(coast), "coast");
  must(skerry_echo_chart_destroy(chart), "chart");
  return 0;
}
