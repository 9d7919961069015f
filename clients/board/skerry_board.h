// Skerry's radar interface boards, for programs written against such a board: libskerry_board.so.
//
// open -> registers, arm, sweeps, ARP -> close.  README.md beside this file walks through it,
// protocol/BOARD.md of Skerry specifies the registers and what a sweep's metadata mean.
//
// C99; compiles as C and as C++.
//
// Results.  Every call but the few that return text gives 0 (SKB_OK) or an error code, and leaves a
// text for skb_last_error().  A call that fails changes nothing in the caller's memory except where
// stated.  No exception leaves the library, and nothing that a server sends makes it crash.
//
// Handles.  Never an address: a ticket that is looked up at every call, so that NULL, a board
// closed already or any other pointer gives SKB_ERROR_HANDLE.
//
// Threads.  Any thread may call.  A board is used by one thread at a time: a call while another is
// running on the same board is refused with SKB_ERROR_BUSY and does nothing.  Different boards
// never wait for each other; open the same board twice to read registers while sweeps are read. The
// library starts no threads and handles no signals.
//
// Time.  No call waits longer than its timeout (skb_open: than its timeout and the system's name
// lookup); all timeouts are milliseconds, 0 looks at what is there already.  At most
// SKB_LONGEST_TIMEOUT_MS.
//
// Memory.  All buffers are the caller's; the library keeps no pointer to them after the call.
//
// Structures grow at the end: the caller says how much of one it knows (sizeof), the library fills
// that much, with 0 in what it does not know.
#ifndef SKERRY_BOARD_H
#define SKERRY_BOARD_H

#include <stddef.h>
#include <stdint.h>

// Of this interface.  The major number changes when old programs no longer run (it is the .so's);
// the minor one when something is added.
#define SKB_VERSION_MAJOR 1
#define SKB_VERSION_MINOR 0
#define SKB_VERSION_PATCH 0

#if defined(__GNUC__)
#define SKB_API __attribute__((visibility("default")))
#else
#define SKB_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

// ---- Results and version ------------------------------------------------------------------------

enum {
  SKB_OK = 0,
  SKB_ERROR_ARGUMENT = 1,     // NULL or out of its range; the text says which
  SKB_ERROR_HANDLE = 2,       // NULL, closed, or never a board
  SKB_ERROR_BUSY = 3,         // another thread is in a call on the board
  SKB_ERROR_SIZE = 4,         // a buffer is too small; the text says what is needed
  SKB_ERROR_TIMEOUT = 5,      // nothing came, or no answer, in time; the board stays open
  SKB_ERROR_UNREACHABLE = 6,  // no such host, nobody listens there, or memory not to be mapped
  SKB_ERROR_CLOSED = 7,       // the server has gone: close the board and open it again
  SKB_ERROR_REJECTED = 8,     // the server said no; the text says why
  SKB_ERROR_PROTOCOL = 9,     // what came is no board's; close the board
  SKB_ERROR_UNKNOWN_REGISTER = 10,  // the board's own error codes, as in protocol/BOARD.md
  SKB_ERROR_READ_ONLY = 11,
  SKB_ERROR_OUT_OF_RANGE = 12,
  SKB_ERROR_MISALIGNED = 13,
  SKB_ERROR_MEMORY = 14,
  SKB_ERROR_INTERNAL = 15  // a fault of the library
};

#define SKB_LONGEST_TIMEOUT_MS 3600000u

// Major << 16 | minor << 8 | patch of the library loaded.
SKB_API uint32_t skb_version(void);
// "1.0.0 (skerry 0.1.0)".
SKB_API const char* skb_version_text(void);
// What was wrong, where, and what is allowed, of the last call of this thread that failed; ""
// before that.  ASCII, one line, at most 511 bytes; good until the thread's next call.
SKB_API const char* skb_last_error(void);
// "OK", "ARGUMENT", ...; "UNKNOWN" for what is no code.
SKB_API const char* skb_result_name(int32_t result);

// ---- Opening and closing ------------------------------------------------------------------------

typedef struct skb_board skb_board;

// Connects to the interface board of a radar.
// place: "tcp://host:port/radar": registers and sweeps over one TCP connection; or
// "shm://host:port/radar": sweeps from the ring in shared memory instead, for programs of the
// server's own user on its own host.  Memory of another user than the caller's own or root is not
// mapped, not for root either: its owner could cut it short under the reader, and a read beyond the
// end is the signal SIGBUS, which ends a program.  skerryd never shortens its ring.
// host: a name, an IPv4 address, or an IPv6 address in brackets.  ":port" and "/radar" may be left
// out: 7410 and 0.
// token: what the server demands of other hosts before it lets them write; may be NULL.
// timeout_ms: for connecting, and for every later request to the board's registers; from 1.
// *board: to be given back with skb_close(); NULL after an error.
SKB_API int32_t skb_open(const char* place, const char* token, uint32_t timeout_ms,
                         skb_board** board);

// Lets go of the board.  A call that another thread has running on it ends by its own timeout.
SKB_API int32_t skb_close(skb_board* board);

// Copies what it is, e.g. "radar 0 (Mast) of 127.0.0.1:7410, skerryd 0.1.0", with its ending 0.
// *size: bytes it takes; set too where `capacity` is too small (SKB_ERROR_SIZE).  text may be NULL
// with capacity 0, which asks for the size alone.
SKB_API int32_t skb_describe(skb_board* board, char* text, size_t capacity, size_t* size);

// ---- Registers ----------------------------------------------------------------------------------
// Each call is one access, carried out by the board at one instant.  A write that the board refuses
// (SKB_ERROR_UNKNOWN_REGISTER, _READ_ONLY, _OUT_OF_RANGE, _MISALIGNED) changes nothing; the text
// names the register and the range allowed.

// address: in bytes, a multiple of 4.
SKB_API int32_t skb_read_register(skb_board* board, uint32_t address, uint32_t* value);
SKB_API int32_t skb_write_register(skb_board* board, uint32_t address, uint32_t value);
// Both halves of a 64-bit value, which belong together; address: the low one's.
SKB_API int32_t skb_read_register64(skb_board* board, uint32_t address, uint64_t* value);
// values[i] = the register at addresses[i], all at one instant.  count: 1 to 256.
SKB_API int32_t skb_read_registers(skb_board* board, const uint32_t* addresses, uint32_t* values,
                                   size_t count);

// Reads a register by name, e.g. "PRF_MILLIHERTZ", letters of either case.  A 64-bit value has its
// name without _LOW: "CLOCKS", "LATCHED_UTC_NS".  A signed register's value is signed.
SKB_API int32_t skb_read_named(skb_board* board, const char* name, int64_t* value);
SKB_API int32_t skb_write_named(skb_board* board, const char* name, int64_t value);
// Needs no board.
SKB_API int32_t skb_find_register(const char* name, uint32_t* address);

// Bits of CONTROL, STATUS, FAULTS (also skb_sweep.faults) and EVENTS (also skb_event.event).
enum {
  SKB_CONTROL_RUN = 1,    // triggers are captured as they come
  SKB_CONTROL_RESET = 2,  // counts, FIFO and faults to 0
  SKB_CONTROL_ARM = 4,    // capture the next trigger into the FIFO
  SKB_CONTROL_FIFO = 8,   // while running, captured sweeps go to the FIFO too

  SKB_STATUS_RUNNING = 1,
  SKB_STATUS_ARMED = 2,
  SKB_STATUS_CAPTURED = 4,
  SKB_STATUS_RADIATING = 8,
  SKB_STATUS_FAULT = 16,

  SKB_FAULT_CONFIG = 1,  // settings contradict each other: skb_fault_reason()
  SKB_FAULT_ACP_MISSING = 2,
  SKB_FAULT_ACP_EXTRA = 4,
  SKB_FAULT_ARP_MISSING = 8,
  SKB_FAULT_STALLED = 16,
  SKB_FAULT_OVERRUN = 32,
  SKB_FAULT_LATE = 64,

  SKB_EVENT_ARP = 1,
  SKB_EVENT_HEADING = 2,
  SKB_EVENT_FAULT_RAISED = 4,
  SKB_EVENT_FAULT_CLEARED = 8,
  SKB_EVENT_CAPTURED = 16,
  SKB_EVENT_CONFIGURED = 32,
  SKB_EVENT_RESET = 64
};

// Why SKB_FAULT_CONFIG is set, "" if it is not; copied as by skb_describe().
SKB_API int32_t skb_fault_reason(skb_board* board, char* text, size_t capacity, size_t* size);

// ---- Sweeps -------------------------------------------------------------------------------------

typedef struct skb_channel {
  uint32_t samples;       // 0: the channel is off
  uint32_t decimation;    // ticks of the sample clock to one of them
  uint32_t mode;          // of decimation: 0 peak, 1 mean, 2 sum
  uint32_t bits;          // of the converter: 8, 10, 12 or 14
  uint32_t largest_code;  // 1 to 65535
  uint32_t detector;      // 0 logarithmic, 1 linear
  uint32_t inverted;      // 1: the strongest echo reads 0
  uint32_t reserved;      // 0
  double first_range_m;   // metres to the middle of sample 0 ...
  double range_step_m;    // ... and from one sample to the next
} skb_channel;

// Values that the board latched at the trigger.  Ticks are of the sample clock.
typedef struct skb_sweep {
  uint64_t sequence;  // +1 for every record of the board, of whatever kind; 0 from the FIFO
  uint64_t trigger_count;
  uint64_t trigger_tick;  // since scenario time 0
  uint64_t utc_ns;        // since 1970-01-01 UTC
  double azimuth_turns;   // clockwise from the ARP, in [0, 1): ACPs and the fraction of one
  uint32_t radar;
  uint32_t sample_clock_hz;
  uint32_t acp_count;        // since the last ARP
  uint32_t ticks_since_acp;  // from the last ACP to the trigger
  uint32_t acp_period;       // ticks between the last two ACPs; 0: there were none yet
  uint32_t acp_per_turn;     // as configured
  uint32_t arp_ticks;        // from the ACP before the last ARP to that ARP
  uint32_t arp_count;
  uint32_t delay_ticks;  // from the trigger (range zero) to the first sample
  uint32_t pulse_ns;
  uint32_t prf_millihertz;
  uint32_t faults;           // SKB_FAULT_*, at that trigger
  uint32_t pulses;           // integrated into this one
  uint32_t spoke;            // of a formed spoke: its index in the turn
  uint32_t spokes_per_turn;  // 0: a sweep of one trigger
  uint32_t turn_ticks;       // between the last two ARPs; 0: that turn had not all its ACPs
  skb_channel channel[2];    // A, B
} skb_sweep;

// Begins the stream of sweeps and events, with the newest; what was waiting is forgotten and
// skb_lost() is 0 again.  The first skb_read_sweep() or skb_wait_...() does it by itself.
SKB_API int32_t skb_start(skb_board* board);

// The next sweep of the stream: metadata, and the samples of both channels (codes, nearest first).
// sweep_size: sizeof(skb_sweep).  capacities: in samples; a channel whose pointer is NULL (capacity
// 0) is left out.  A program that reads too slowly loses the oldest: skb_lost().
// Error: SIZE, where a buffer is too small: then *sweep is filled all the same and the sweep stays
// the next one; TIMEOUT, where none came.
SKB_API int32_t skb_read_sweep(skb_board* board, uint32_t timeout_ms, skb_sweep* sweep,
                               size_t sweep_size, uint16_t* a, size_t a_capacity, uint16_t* b,
                               size_t b_capacity);

// Has the board capture the sweep of the next trigger into its FIFO, running or not.  CONTROL is
// neither read nor written, so what other programs set there stays: DIGDAR_TRIG_SOURCE becomes 2
// until the sweep is captured, and DIGDAR_COMMAND's bit 0 is written, in one access.
SKB_API int32_t skb_arm(skb_board* board);

// The oldest sweep of the board's FIFO, which leaves it; waits for one.  Otherwise as
// skb_read_sweep().  With several programs at one board each sweep goes to one of them.
SKB_API int32_t skb_read_fifo(skb_board* board, uint32_t timeout_ms, skb_sweep* sweep,
                              size_t sweep_size, uint16_t* a, size_t a_capacity, uint16_t* b,
                              size_t b_capacity);

typedef struct skb_event {
  uint64_t tick;    // since scenario time 0
  uint32_t event;   // one SKB_EVENT_*
  uint32_t faults;  // SKB_FAULT_* raised or cleared
  uint32_t value;   // by event (protocol/BOARD.md); ARP: ARP_COUNT, 0 where that is not known
  uint32_t radar;
} skb_event;

// Waits for the antenna reference pulse.  The sweeps of the triggers before it are passed over: the
// next skb_read_sweep() gives the first of the turn that begins.
// event: may be NULL, with event_size 0; else event_size: sizeof(skb_event).
SKB_API int32_t skb_wait_arp(skb_board* board, uint32_t timeout_ms, skb_event* event,
                             size_t event_size);
// The same for the first of `events`, SKB_EVENT_* or-ed, that comes; those that EVENT_ENABLE leaves
// out do not (but the ARP).
SKB_API int32_t skb_wait_event(skb_board* board, uint32_t events, uint32_t timeout_ms,
                               skb_event* event, size_t event_size);

// Records of the stream that this program was too slow for, since it began.
SKB_API int32_t skb_lost(skb_board* board, uint64_t* records);
// Sweeps that the board's FIFO had no room for.  channel: 0 or 1.
SKB_API int32_t skb_overruns(skb_board* board, uint32_t channel, uint32_t* sweeps);

#ifdef __cplusplus
}
#endif

#endif
