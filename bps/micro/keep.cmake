# Before a run writes FILE.json: what is there becomes FILE-before.json.
cmake_path(GET FILE PARENT_PATH folder)
file(MAKE_DIRECTORY "${folder}")
if(EXISTS "${FILE}.json")
  file(RENAME "${FILE}.json" "${FILE}-before.json")
endif()
