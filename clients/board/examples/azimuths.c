/* Reads one turn of a radar's interface board and prints each sweep's azimuth and strongest echo.
 *
 *   azimuths [place]        place: "tcp://127.0.0.1:7410/0", or "shm://..." on the server's host
 */
#include <stdio.h>
#include <stdlib.h>

#include <skerry_board.h>

enum { kTimeoutMs = 10000, kMostSamples = 16384 };

static void require(int32_t result, const char* what) {
  if (result == SKB_OK) return;
  fprintf(stderr, "azimuths: %s: %s: %s\n", what, skb_result_name(result), skb_last_error());
  exit(1);
}

int main(int argc, char** argv) {
  static uint16_t samples[kMostSamples];
  const char* place = argc > 1 ? argv[1] : "tcp://127.0.0.1:7410/0";
  char name[256];
  size_t size;
  int64_t acps;
  uint32_t turn;
  uint64_t lost;
  unsigned long sweeps = 0;
  skb_sweep sweep;
  skb_board* board;

  require(skb_open(place, NULL, kTimeoutMs, &board), place);
  require(skb_describe(board, name, sizeof name, &size), "describe");
  require(skb_read_named(board, "ACP_PER_TURN", &acps), "ACP_PER_TURN");
  printf("# %s: %ld ACPs a turn\n", name, (long)acps);

  require(skb_wait_arp(board, kTimeoutMs, NULL, 0), "ARP");
  require(skb_read_sweep(board, kTimeoutMs, &sweep, sizeof sweep, samples, kMostSamples, NULL, 0),
          "sweep");
  for (turn = sweep.arp_count; sweep.arp_count == turn; ++sweeps) {
    const skb_channel* a = &sweep.channel[0];
    uint32_t i, strongest = 0;
    for (i = 1; i < a->samples; ++i) {
      if (samples[i] > samples[strongest]) strongest = i;
    }
    printf("%9.4f deg  %5u of %u at %8.1f m\n", 360.0 * sweep.azimuth_turns,
           (unsigned)samples[strongest], (unsigned)a->largest_code,
           a->first_range_m + strongest * a->range_step_m);
    require(skb_read_sweep(board, kTimeoutMs, &sweep, sizeof sweep, samples, kMostSamples, NULL, 0),
            "sweep");
  }
  require(skb_lost(board, &lost), "lost");
  fprintf(stderr, "%lu sweeps, %lu records lost\n", sweeps, (unsigned long)lost);
  require(skb_close(board), "close");
  return 0;
}
