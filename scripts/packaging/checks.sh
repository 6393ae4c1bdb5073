# shellcheck shell=bash disable=SC2154
# To be sourced: checks that say what holds, and how many did. Set `log` to a file for the words of
# what fails.
passed=0 failed=0
check() { # check SENTENCE COMMAND...
  local sentence=$1 start=$SECONDS
  shift
  if "$@" >"$log" 2>&1 </dev/null; then
    passed=$((passed + 1))
    echo "pass: $sentence ($((SECONDS - start)) s)"
  else
    failed=$((failed + 1))
    echo "FAIL: $sentence ($((SECONDS - start)) s)"
    tail -n 25 "$log" | sed 's/^/      /'
    return 1
  fi
}
summary() { # the exit code says whether all did
  echo "$passed passed, $failed failed"
  [ "$failed" -eq 0 ] && [ "$passed" -gt 0 ]
}
