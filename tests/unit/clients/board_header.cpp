// skerry_board.h as a strict C++11 compiler sees it.
#include <skerry_board.h>

uint32_t board_header_in_cpp() { return skb_version(); }
