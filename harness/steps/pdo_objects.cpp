// SPDX-License-Identifier: Apache-2.0
#include "steps/pdo_objects.hpp"

#include "base/text.hpp"
#include "canopen/abort_code.hpp"
#include "canopen/pdo.hpp"

namespace conform::steps {

Result<Index> communication_of(const ObjectReference& pdo, Session& session) {
  const auto object = pdo.resolve(session);
  if (!object) return std::unexpected(object.error());
  if (const auto index = canopen::pdo_communication(object->index)) return *index;
  return fail_scenario(to_string(*object) + " is not a PDO",
                       "1400h-15FFh, 1800h-19FFh or the mapping of one");
}

std::string pdo_words(const ObjectReference& pdo, Session& session) {
  const auto index = communication_of(pdo, session);
  if (!index) return pdo.text();
  const bool receive = is_receive_pdo(*index);
  return (receive ? "RPDO " : "TPDO ") + std::to_string(index->value() - (receive ? 0x1400 : 0x1800) + 1);
}

Result<void> will_receive(Session& session, Index mapping, std::uint64_t entry) {
  const auto object = canopen::mapped_object(entry);
  return is_receive_pdo(mapping) && object.index > Index(0x1F) ? session.will_change(object) : Result<void>();
}

bool is_absent(const Actual& actual) {
  return actual.kind == Actual::Kind::aborted &&
         (actual.code == canopen::abort::no_object || actual.code == canopen::abort::no_sub_index);
}

}  // namespace conform::steps
