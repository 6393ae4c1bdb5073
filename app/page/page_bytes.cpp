#include "app/page/page_bytes.h"

#include <zlib.h>

#include <stdexcept>

#include "app/data/html_page.h"
#include "app/page/draw_columns.h"

namespace twinarm {

void PageBytes::write_place(JsonWriter& json, const void* data, std::size_t count, std::size_t size,
                            const char* type) {
  const std::size_t at = append_array(bytes_, data, count * size);
  json.object({{"at", at}, {"count", count}, {"type", type}});
}

std::string PageBytes::packed() const {
  uLongf size = compressBound(static_cast<uLong>(bytes_.size()));
  std::string deflated(size, '\0');
  const int result = compress2(reinterpret_cast<Bytef*>(deflated.data()), &size,
                               reinterpret_cast<const Bytef*>(bytes_.data()),
                               static_cast<uLong>(bytes_.size()), 8);
  if (result != Z_OK) throw std::runtime_error("zlib: compress2 failed");
  deflated.resize(size);
  return base64_of(deflated);
}

}  // namespace twinarm
