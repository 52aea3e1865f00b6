#!/bin/bash
# The program of the container: docs/manual/installing.md, "In a container".
#
#   without arguments   `passo serve` at port PASSO_PORT (7080), with the options in PASSO_OPTIONS; other computers reach it, so it has
#                       a token, which is made at the first start
#   health              whether that server answers, and has not lost its board
#   COMMAND...          passo COMMAND...
set -euo pipefail

folder=/var/lib/passo
token=$folder/token
port=${PASSO_PORT:-7080}

case "${1-}" in
  "")
    if [[ ! -s $token ]]; then
      (umask 077 && od --address-radix=n --format=x1 --read-bytes=16 /dev/urandom | tr -d ' ' >"$token.unfinished")
      mv "$token.unfinished" "$token"
    fi
    echo "Web interface: http://localhost:$port/#token=$(head -n 1 "$token")"
    # Options, of which each is a word.
    # shellcheck disable=SC2086
    exec passo serve --http "0.0.0.0:$port" --http-token "$token" --data "$folder" ${PASSO_OPTIONS-}
    ;;
  health)
    exec 3<>"/dev/tcp/127.0.0.1/$port"
    printf 'GET /api/v1/health HTTP/1.1\r\nHost: localhost\r\nAuthorization: Bearer %s\r\nConnection: close\r\n\r\n' \
      "$(head -n 1 "$token")" >&3
    read -r _ status _ <&3
    [[ $status == 200 ]]
    ;;
  *)
    exec passo "$@"
    ;;
esac
