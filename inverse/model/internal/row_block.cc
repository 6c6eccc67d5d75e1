#include "inverse/model/internal/row_block.h"

#include "inverse/model/internal/outline_block.h"
#include "inverse/model/internal/photo_block.h"
#include "inverse/model/internal/reading_block.h"

namespace luxfit {

std::vector<std::unique_ptr<RowBlock>> RowBlocksOf(const Room& room, const LightData& data) {
  std::vector<std::unique_ptr<RowBlock>> blocks;
  blocks.push_back(std::make_unique<PhotoBlock>(room, data));
  blocks.push_back(std::make_unique<ReadingBlock>(data));
  blocks.push_back(std::make_unique<OutlineBlock>(data));
  return blocks;
}

}  // namespace luxfit
