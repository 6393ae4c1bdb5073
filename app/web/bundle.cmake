# Writes BUNDLE, a C++ file with the pages' templates or with what is missing.
# cmake -D NODE=.. -D NPM=.. -D SOURCE=.. -D OUT=.. -D BUNDLE=.. -P bundle.cmake
set(missing "")
set(remedy "then run scripts/build again")

if(NOT NODE OR NOT NPM)
  set(missing "the program was built without Node: scripts/setup --lab installs it, ${remedy}")
else()
  # Packages as the lock file has them, by their hashes; only where that has changed.
  file(MAKE_DIRECTORY ${OUT})
  set(stamp ${OUT}/package-lock.done)
  file(SHA256 ${SOURCE}/package-lock.json lock)
  set(done "")
  if(EXISTS ${stamp})
    file(READ ${stamp} done)
  endif()
  if(NOT done STREQUAL lock)
    file(COPY ${SOURCE}/package.json ${SOURCE}/package-lock.json ${SOURCE}/.npmrc
      DESTINATION ${OUT})
    execute_process(
      COMMAND ${NPM} ci --omit=dev --ignore-scripts --prefer-offline --fetch-retries=1
        --loglevel=error
      WORKING_DIRECTORY ${OUT} TIMEOUT 240
      OUTPUT_QUIET ERROR_VARIABLE said RESULT_VARIABLE failed)
    if(failed)
      string(CONCAT missing "the packages of app/web could not be installed (npm ci): "
        "give the build a network, ${remedy}")
    else()
      file(WRITE ${stamp} ${lock})
    endif()
  endif()
  if(NOT missing)
    execute_process(
      COMMAND ${NODE} ${SOURCE}/build.mjs ${OUT}/node_modules ${BUNDLE}
      TIMEOUT 240 ERROR_VARIABLE said RESULT_VARIABLE failed)
    if(failed)
      set(missing "the pages could not be bundled: mend app/web, ${remedy}")
    endif()
  endif()
endif()

if(missing)
  message(WARNING "${missing}\n${said}")
  file(WRITE ${BUNDLE}.missing "${said}")
  file(WRITE ${BUNDLE} "// Made by app/web/bundle.cmake.
#include \"app/web/web_bundle.h\"
namespace twinarm {
WebBundle web_bundle() { return {\"\", \"\", \"\", \"${missing}\"}; }
}  // namespace twinarm
")
else()
  file(REMOVE ${BUNDLE}.missing)
endif()
