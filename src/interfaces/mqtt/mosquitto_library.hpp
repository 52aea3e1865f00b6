// libmosquitto, loaded when --mqtt is given. It also loads OpenSSL, which takes a sixth of the memory and a third of
// the time of a program start, and which no other command needs (decision 0166). Private to mqtt/.
#pragma once

#include "lazy_library.hpp"
#include <mosquitto.h>

namespace passo {

struct MosquittoLibrary {
  LazyLibrary library{PASSO_MOSQUITTO_NAME};
  PASSO_FUNCTION(mosquitto_lib_init);
  PASSO_FUNCTION(mosquitto_lib_cleanup);
  PASSO_FUNCTION(mosquitto_new);
  PASSO_FUNCTION(mosquitto_destroy);
  PASSO_FUNCTION(mosquitto_threaded_set);
  PASSO_FUNCTION(mosquitto_will_set);
  PASSO_FUNCTION(mosquitto_username_pw_set);
  PASSO_FUNCTION(mosquitto_connect_callback_set);
  PASSO_FUNCTION(mosquitto_connect_async);
  PASSO_FUNCTION(mosquitto_loop);
  PASSO_FUNCTION(mosquitto_publish);
  PASSO_FUNCTION(mosquitto_disconnect);
  PASSO_FUNCTION(mosquitto_strerror);
};

}  // namespace passo
