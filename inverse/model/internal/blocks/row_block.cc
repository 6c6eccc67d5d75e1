#include "inverse/model/internal/blocks/row_block.h"

#include "inverse/model/internal/blocks/outline_block.h"
#include "inverse/model/internal/blocks/photo_block.h"
#include "inverse/model/internal/blocks/reading_block.h"

namespace luxfit {

std::vector<std::unique_ptr<RowBlock>> RowBlocksOf(const Room& room, const LightData& data) {
  std::vector<std::unique_ptr<RowBlock>> blocks;
  blocks.push_back(std::make_unique<PhotoBlock>(room, data));
  blocks.push_back(std::make_unique<ReadingBlock>(data));
  blocks.push_back(std::make_unique<OutlineBlock>(data));
  return blocks;
}

}  // namespace luxfit
