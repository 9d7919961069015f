// The only place in clients/ that names Boost.Asio.  Boost 1.74 with g++ 12 needs <utility> first.
#pragma once

#include <utility>

#include <boost/asio.hpp>
#include <boost/asio/ssl.hpp>
