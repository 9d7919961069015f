// Skerry's radar echo of fractal coasts and ships, for other simulators to load: libskerry_echo.so.
//
// chart -> coast -> radar -> spokes.  Open a chart, make a coast of it (how it is refined between
// the chart's vertices), mount a radar on that coast, tell it where the ships are (a scene), and
// have it render spokes of 8-bit video.  README.md beside this file walks through it.
//
// C99; compiles as C and as C++.
//
// Results.  Every call but the few that return text gives 0 (SKERRY_ECHO_OK) or an error code, and
// leaves a text for skerry_echo_last_error().  A call that fails changes nothing: neither the
// object nor, except where stated, what the pointers given point to.  No exception leaves the
// library.
//
// Handles.  Never an address: a ticket that is looked up at every call, so that NULL, a destroyed
// handle, a handle of another kind or any other pointer gives SKERRY_ECHO_ERROR_HANDLE.  What a
// call makes the caller owns, and gives back with the destroy call of its kind; in any order, as
// whatever was made out of a chart or a coast keeps its own hold on it.
//
// Threads.  Any thread may call.  A chart may be shared by threads at will.  A coast or a radar is
// used by one thread at a time: a call while another is running on the same handle is refused with
// SKERRY_ECHO_ERROR_BUSY and does nothing.  Different handles never wait for each other, but while
// two read charts.  The library starts no threads and asks no clock.
//
// Memory.  All buffers are the caller's; the library keeps no pointer to them after the call. Texts
// returned as const char* belong to the library.
//
// Structures grow at the end.  `struct_size` says how much of one the caller knows; the
// *_defaults() calls set it and fill in the rest.  What an older caller does not know has its
// default; what a newer caller knows and this library does not must be 0, else
// SKERRY_ECHO_ERROR_SIZE.
//
// Determinism.  The same calls give the same bytes, on any machine, in any process; and the same
// video as skerryd makes of that chart, seed and scene.  (Latitudes and longitudes handed OUT go
// through libm and may differ in the last bits.)
#ifndef SKERRY_ECHO_H
#define SKERRY_ECHO_H

#include <stddef.h>
#include <stdint.h>

// Of this interface.  The major number changes when old programs no longer run (it is the .so's);
// the minor one when something is added.
#define SKERRY_ECHO_VERSION_MAJOR 1
#define SKERRY_ECHO_VERSION_MINOR 0
#define SKERRY_ECHO_VERSION_PATCH 0

#if defined(__GNUC__)
#define SKERRY_ECHO_API __attribute__((visibility("default")))
#else
#define SKERRY_ECHO_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

// ---- Results and version ------------------------------------------------------------------------

enum {
  SKERRY_ECHO_OK = 0,
  SKERRY_ECHO_ERROR_ARGUMENT = 1,  // NULL, not a number, or out of its range; the text says which
  SKERRY_ECHO_ERROR_HANDLE = 2,    // NULL, destroyed, of another kind, or never a handle
  SKERRY_ECHO_ERROR_BUSY = 3,      // another thread is in a call on the handle
  SKERRY_ECHO_ERROR_SIZE = 4,      // a buffer or a struct_size is too small or makes no sense
  SKERRY_ECHO_ERROR_STATE = 5,     // something else must be called first; the text says what
  SKERRY_ECHO_ERROR_CHART = 6,     // a chart is missing, damaged or not one; text: file and object
  SKERRY_ECHO_ERROR_MEMORY = 7,
  SKERRY_ECHO_ERROR_INTERNAL = 8  // a fault of the library
};

// Major << 16 | minor << 8 | patch of the library loaded.
SKERRY_ECHO_API uint32_t skerry_echo_version(void);
// "1.0.0 (skerry 0.1.0)".
SKERRY_ECHO_API const char* skerry_echo_version_text(void);
// What was wrong, where, and what is allowed, of the last call of this thread that failed; ""
// before that.  UTF-8, one line, at most 511 bytes; good until the thread's next call.
SKERRY_ECHO_API const char* skerry_echo_last_error(void);
// "OK", "ARGUMENT", ...; "UNKNOWN" for what is no code.
SKERRY_ECHO_API const char* skerry_echo_result_name(int32_t result);

// ---- Charts -------------------------------------------------------------------------------------

typedef struct skerry_echo_chart skerry_echo_chart;
typedef struct skerry_echo_coast skerry_echo_coast;
typedef struct skerry_echo_radar skerry_echo_radar;

// WGS-84 degrees: latitude -90 to 90, longitude -180 to 180.
typedef struct skerry_echo_position {
  double latitude_deg;
  double longitude_deg;
} skerry_echo_position;

// Metres east and north of the anchor of a plane (skerry_echo_picture), azimuthal equidistant.
typedef struct skerry_echo_plane_point {
  double east_m;
  double north_m;
} skerry_echo_plane_point;

// How a coast echoes, by the types of the method's paper.
enum {
  SKERRY_ECHO_COAST_UNKNOWN = 0,     // the chart does not say
  SKERRY_ECHO_COAST_ARTIFICIAL = 1,  // I: quay, mole, wall: straight, sharp, strong
  SKERRY_ECHO_COAST_ROCKY = 2,       // II: fractal
  SKERRY_ECHO_COAST_SANDY = 3,       // III: flat sand or mud: weak, deep
  SKERRY_ECHO_COAST_SEAM = 4         // out only: land ends where a chart ends; no shore
};
// For a type that may be left as charted.
#define SKERRY_ECHO_COAST_AS_CHARTED (-1)

// Opens charts by the names of files or folders: GSHHG (.nc), ENC cells (.000, their updates beside
// them), folders of either, GeoJSON (.geojson, .json), Shapefiles (.shp); "" is the finest GSHHG
// installed (Debian: gmt-gshhg-full).  paths[0] lies over paths[1] and so on, each where it has
// coverage.  count: 1 to 1024.
// elevations: rasters of the ground's height (GeoTIFF, DTED, SRTM), in the same order; may be NULL
// with elevation_count 0 (to 64), where the land's height is made up from its coast.
// Costs the reading of the cells and indices; GSHHG is read where a coast or a radar needs it.
SKERRY_ECHO_API int32_t skerry_echo_chart_open(const char* const* paths, size_t count,
                                               const char* const* elevations,
                                               size_t elevation_count, skerry_echo_chart** chart);

// A chart from the caller's own rings, each closed (its last vertex joins its first) with LAND ON
// THE LEFT: land counter-clockwise, a lake in it clockwise.  What no ring bounds is sea.
// vertices: of all rings, one after the other, taken to 1e-7 deg (1 cm); at most 20 000 000.
// ring_sizes[r] vertices make up ring r, 3 or more different ones, all within 1000 km of its first.
// ring_types[r]: SKERRY_ECHO_COAST_UNKNOWN to _SANDY; ring_types may be NULL: all unknown.
// vertex_count must be the sum of ring_sizes; 0 rings is open sea.
SKERRY_ECHO_API int32_t skerry_echo_chart_from_rings(const skerry_echo_position* vertices,
                                                     size_t vertex_count, const size_t* ring_sizes,
                                                     const int32_t* ring_types, size_t ring_count,
                                                     skerry_echo_chart** chart);

// Copies the chart's name, e.g. "GSHHG 2.3.7 full", with its ending 0.  *size: bytes it takes; set
// too where `capacity` is too small (SKERRY_ECHO_ERROR_SIZE).  text may be NULL with capacity 0,
// which asks for the size alone.
SKERRY_ECHO_API int32_t skerry_echo_chart_describe(skerry_echo_chart* chart, char* text,
                                                   size_t capacity, size_t* size);

// The same for what of the chart's files cannot be used and why: a line for each file and object,
// parted by '\n'; an empty text where all can.
SKERRY_ECHO_API int32_t skerry_echo_chart_warnings(skerry_echo_chart* chart, char* text,
                                                   size_t capacity, size_t* size);

// *land: 1 on land, 0 afloat, by the chart's straight edges; on the shore either.  Costs 2 ns per
// vertex within 12 NM, and the reading of the chart every few miles.
SKERRY_ECHO_API int32_t skerry_echo_chart_is_land(skerry_echo_chart* chart, double latitude_deg,
                                                  double longitude_deg, int32_t* land);

// NULL is no error.
SKERRY_ECHO_API int32_t skerry_echo_chart_destroy(skerry_echo_chart* chart);

// ---- Coasts -------------------------------------------------------------------------------------

// How the coast between two vertices of the chart is grown.
enum {
  SKERRY_ECHO_METHOD_STRAIGHT = 0,      // the chart's edge as it is; dimension 1
  SKERRY_ECHO_METHOD_REGULAR_KOCH = 1,  // dimension 1 to 1.25
  SKERRY_ECHO_METHOD_RANDOM_KOCH = 2,   // 1 to 1.175
  SKERRY_ECHO_METHOD_MIDPOINT = 3,      // fractional Brownian motion, H = 2 - dimension; 1 to 1.5
  SKERRY_ECHO_METHOD_WEIERSTRASS = 4    // Weierstrass-Mandelbrot function; 1 to 1.5
};
// Phases of the Weierstrass-Mandelbrot series.
enum {
  SKERRY_ECHO_PHASES_COSINE = 0,       // all 0
  SKERRY_ECHO_PHASES_ALTERNATING = 1,  // n pi
  SKERRY_ECHO_PHASES_RANDOM = 2        // from the coast's seed
};

typedef struct skerry_echo_style {
  uint32_t struct_size;
  int32_t method;     // SKERRY_ECHO_METHOD_...
  int32_t phases;     // SKERRY_ECHO_PHASES_...; Weierstrass only
  uint32_t reserved;  // 0
  double dimension;   // 1 to what the method can have
  double amplitude;   // factor on what dimension and edge length imply; 0 to 4
  double gamma;       // ratio of wave numbers, 1.05 to 8; Weierstrass only
} skerry_echo_style;

// Fills *style with what a coast type has unless told otherwise.  size: sizeof(skerry_echo_style).
SKERRY_ECHO_API int32_t skerry_echo_style_defaults(int32_t type, skerry_echo_style* style,
                                                   size_t size);

// A coast of that chart, with default styles.  `seed` makes another coast between the same chart
// vertices; whoever has the same chart and seed has the same coast, from wherever it is looked at.
SKERRY_ECHO_API int32_t skerry_echo_coast_create(skerry_echo_chart* chart, uint64_t seed,
                                                 skerry_echo_coast** coast);

// The style of all coast of a type (SKERRY_ECHO_COAST_UNKNOWN to _SANDY).  What was refined before
// stays as it is, radars created before too.
SKERRY_ECHO_API int32_t skerry_echo_coast_set_style(skerry_echo_coast* coast, int32_t type,
                                                    const skerry_echo_style* style);

// guess 1 (the default): coast of unknown type is typed by its own measured dimension; 0: it is
// not.
SKERRY_ECHO_API int32_t skerry_echo_coast_set_guessing(skerry_echo_coast* coast, int32_t guess);

// More than the chart says of chart edges whose middle lies within radius_m (10 to 200 000) of a
// place.  type: SKERRY_ECHO_COAST_UNKNOWN to _SANDY, or _AS_CHARTED; style: NULL for the type's.
// A later place wins over an earlier one.  At most 1000 places.
SKERRY_ECHO_API int32_t skerry_echo_coast_add_place(skerry_echo_coast* coast, double latitude_deg,
                                                    double longitude_deg, double radius_m,
                                                    int32_t type, const skerry_echo_style* style);

// Refines the coast around a place, as finely as a radar there can tell apart, and keeps it to be
// copied out.
// range_m: 200 to 200 000.  cell_m: size of a range cell, range_m/4096 to range_m/16.  spoke_deg:
// angle between spokes, 360/8192 to 5.
SKERRY_ECHO_API int32_t skerry_echo_coast_refine(skerry_echo_coast* coast, double latitude_deg,
                                                 double longitude_deg, double range_m,
                                                 double cell_m, double spoke_deg);

// The coast refined last: runs of vertices, LAND ON THE LEFT of each.  A closed shoreline is one
// run or several; one that is cut by the range ends there.
typedef struct skerry_echo_picture {
  uint32_t struct_size;   // set by the caller
  int32_t centre_ashore;  // 1: the place it was refined around lies on land
  uint64_t vertices;
  uint64_t runs;
  double anchor_latitude_deg;  // where the plane is anchored
  double anchor_longitude_deg;
  double centre_east_m;  // where it was refined around
  double centre_north_m;
  double complete_m;  // all coast within this of the centre is there; some beyond may be
} skerry_echo_picture;

SKERRY_ECHO_API int32_t skerry_echo_coast_picture(skerry_echo_coast* coast,
                                                  skerry_echo_picture* picture);

// Each copies an array of what was refined last.  capacity: elements `out` has room for; *count:
// elements there are, set too where there is no room (SKERRY_ECHO_ERROR_SIZE).  out may be NULL
// with capacity 0, which asks for the count alone.
//   runs: runs + 1 numbers; run r is vertices [out[r], out[r + 1]).
//   plane_vertices, geo_vertices: the vertices, in metres or degrees.  Degrees cost 1 us each.
//   edge_types: SKERRY_ECHO_COAST_... of the edge that begins at each vertex.
SKERRY_ECHO_API int32_t skerry_echo_coast_runs(skerry_echo_coast* coast, uint32_t* out,
                                               size_t capacity, size_t* count);
SKERRY_ECHO_API int32_t skerry_echo_coast_plane_vertices(skerry_echo_coast* coast,
                                                         skerry_echo_plane_point* out,
                                                         size_t capacity, size_t* count);
SKERRY_ECHO_API int32_t skerry_echo_coast_geo_vertices(skerry_echo_coast* coast,
                                                       skerry_echo_position* out, size_t capacity,
                                                       size_t* count);
SKERRY_ECHO_API int32_t skerry_echo_coast_edge_types(skerry_echo_coast* coast, uint8_t* out,
                                                     size_t capacity, size_t* count);

// NULL is no error.
SKERRY_ECHO_API int32_t skerry_echo_coast_destroy(skerry_echo_coast* coast);

// ---- Radars -------------------------------------------------------------------------------------

// Antenna, transmitter and how a turn is cut up: constants of the equipment.
typedef struct skerry_echo_radar_options {
  uint32_t struct_size;
  uint32_t number;           // tells the noise of radars apart
  uint32_t spokes_per_turn;  // 256 to 8192
  uint32_t cells;            // per spoke, 256 to 4096
  uint32_t bits;             // per cell: 4 (values 0 to 15) or 8 (0 to 255); a byte each
  uint32_t reserved;         // 0
  double rpm;                // 1 to 240, to 0.001
  double frequency_hz;       // 2.85e9 to 9.9e9
  double peak_power_w;       // 1 to 100e3
  double antenna_gain_db;    // 15 to 45
  double beam_width_deg;     // horizontal, one way, -3 dB; 0.3 to 7.5
  double antenna_height_m;   // 1 to 100
  double noise_figure_db;    // 0 to 20
  double losses_db;          // 0 to 20
} skerry_echo_radar_options;

// size: sizeof(skerry_echo_radar_options).
SKERRY_ECHO_API int32_t skerry_echo_radar_defaults(skerry_echo_radar_options* options, size_t size);

// A radar that looks at that coast as it is set now: what is set on the coast later does not change
// it.  It begins at 12 NM, gain 50, sea 20, rain 0.
SKERRY_ECHO_API int32_t skerry_echo_radar_create(skerry_echo_coast* coast,
                                                 const skerry_echo_radar_options* options,
                                                 skerry_echo_radar** radar);

// range_nm: 0.125 0.25 0.5 0.75 1.5 3 6 12 24 48 72 96; gain, sea (STC), rain (FTC): 0 to 100.
// A new range scale makes the coast around the ship anew, which takes some ms.
SKERRY_ECHO_API int32_t skerry_echo_radar_set_controls(skerry_echo_radar* radar, double range_nm,
                                                       double gain, double sea, double rain);

// The water's state, which moves a sandy coast's edge and texture; both 0 at first.  water_level_m:
// over the level of the charted coastline (high water), -17 to 15.  wave_height_m: significant, 0
// to 15.
SKERRY_ECHO_API int32_t skerry_echo_radar_set_sea(skerry_echo_radar* radar, double water_level_m,
                                                  double wave_height_m);

// How a ship moves: straight on, turning about her middle.
typedef struct skerry_echo_own_ship {
  uint32_t struct_size;
  uint32_t reserved;       // 0
  double latitude_deg;     // of the antenna, -90 to 90
  double longitude_deg;    // -180 to 180
  double course_deg;       // over ground, true, -360 to 360
  double speed_mps;        // -50 to 50
  double heading_deg;      // true, -360 to 360; spoke 0 points there
  double turn_rate_deg_s;  // to starboard, -30 to 30
} skerry_echo_own_ship;

typedef struct skerry_echo_target {
  uint32_t struct_size;
  uint32_t reserved;  // 0
  uint64_t identity;  // which ship: keeps her echo's pattern from scene to scene
  double latitude_deg;
  double longitude_deg;
  double course_deg;
  double speed_mps;
  double heading_deg;
  double turn_rate_deg_s;
  double length_m;  // 0.3 to 500
  double beam_m;    // 0.1 to 100
  double height_m;  // over the water, 0.1 to 100
} skerry_echo_target;

// sizes: of the structures.  Zero but for struct_size and a target of 60 m by 11 m by 10 m.
SKERRY_ECHO_API int32_t skerry_echo_own_ship_defaults(skerry_echo_own_ship* ship, size_t size);
SKERRY_ECHO_API int32_t skerry_echo_target_defaults(skerry_echo_target* target, size_t size);

// Places of everything at time_ns (-1e18 to 1e18, nanoseconds since the antenna's start).  Motion
// is carried on from there, so a scene serves the spokes of a second or two around its time (see
// render); set one 5 to 20 times a second.  targets: an array, all of one struct_size, which is the
// distance from one to the next; NULL for count 0; at most 10 000.  Reads the chart and refines the
// coast where the own ship has left what is at hand (some ms to some 100 ms every few miles), and
// is otherwise 0.2 us per target.
SKERRY_ECHO_API int32_t skerry_echo_radar_set_scene(skerry_echo_radar* radar, int64_t time_ns,
                                                    const skerry_echo_own_ship* own_ship,
                                                    const skerry_echo_target* targets,
                                                    size_t count);

// When spoke `spoke`, counted from the antenna's start, is on the air: spoke * 60e9 / (rpm *
// spokes_per_turn) ns.  Spoke n points (n mod spokes_per_turn) * 360 / spokes_per_turn deg
// clockwise of the bow.  Error: SKERRY_ECHO_ERROR_ARGUMENT for times over 1e18 ns.
SKERRY_ECHO_API int32_t skerry_echo_radar_spoke_time(skerry_echo_radar* radar, uint64_t spoke,
                                                     int64_t* time_ns);

// Renders spokes first to first + count - 1 (count: 1 to spokes_per_turn), nearest cell first:
// spoke first + k into video[k * stride] to video[k * stride + cells - 1]; bytes between are left
// alone. stride: cells or more.  size: bytes of `video`, (count - 1) * stride + cells or more.
// Spokes are made in ascending order: rays are cast half a beam ahead of them, in the scene then in
// force.  However a turn is cut into calls, the same scenes give the same bytes.
// SKERRY_ECHO_ERROR_STATE: no scene is set, or it is too far off in time: more than 10 s, or so
// much that the own ship has left the coast made for her (at least 10 m and 1 % of the range scale
// away).
SKERRY_ECHO_API int32_t skerry_echo_radar_render(skerry_echo_radar* radar, uint64_t first,
                                                 uint32_t count, uint8_t* video, size_t size,
                                                 size_t stride);

typedef struct skerry_echo_radar_state {
  uint32_t struct_size;     // set by the caller
  int32_t own_ship_ashore;  // 1: the own ship lies on the refined coast's land
  uint64_t coast_edges;     // of the coast in range
  uint64_t coasts_made;     // times the coast was refined
  uint64_t charts_read;     // times the chart was read for it
  double cell_m;            // size of a cell at the range scale set
} skerry_echo_radar_state;

// Error: SKERRY_ECHO_ERROR_STATE before the first scene.
SKERRY_ECHO_API int32_t skerry_echo_radar_get_state(skerry_echo_radar* radar,
                                                    skerry_echo_radar_state* state);

// NULL is no error.
SKERRY_ECHO_API int32_t skerry_echo_radar_destroy(skerry_echo_radar* radar);

#ifdef __cplusplus
}
#endif

#endif  // SKERRY_ECHO_H
