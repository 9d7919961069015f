// skerry_board.h as a strict C99 compiler sees it, before anything else.
#include <skerry_board.h>

int32_t board_header_in_c(void);
int32_t board_header_in_c(void) {
  skb_board* board = NULL;
  skb_sweep sweep;
  skb_event event;
  uint16_t samples[1];
  if (skb_open(NULL, NULL, 0, &board) != SKB_ERROR_ARGUMENT) return 1;
  if (skb_wait_arp(board, 0, &event, sizeof event) != SKB_ERROR_HANDLE) return 2;
  return skb_read_sweep(board, 0, &sweep, sizeof sweep, samples, 1, NULL, 0);
}
