#include "core/energy.hpp"

#include <algorithm>
#include <cmath>

namespace voussoir {

void balance(EnergyLedger& ledger) {
  EnergyFlows& f = ledger.flows;
  if (ledger.phase == LedgerPhase::not_begun) f = {};  // half a kick that belongs to the time before
  const double to_motion = f.gravity + f.contacts + f.prescribed - f.local - f.relaxation;
  const double from_contacts = f.friction + f.dashpots + f.stiffening + f.contacts;

  // at the start, and where the model has changed, the errors stay what they were
  if (ledger.phase != LedgerPhase::running) {
    const double kinetic = ledger.kinetic - to_motion - ledger.motion_error;
    const double elastic = ledger.elastic + from_contacts - ledger.contact_error;
    if (ledger.phase == LedgerPhase::model_changed)
      f.changes += (kinetic - ledger.kinetic_origin) + (elastic - ledger.elastic_origin);
    ledger.kinetic_origin = kinetic;
    ledger.elastic_origin = elastic;
    ledger.phase = LedgerPhase::running;
  }
  ledger.motion_error = (ledger.kinetic - ledger.kinetic_origin) - to_motion;
  ledger.contact_error = (ledger.elastic - ledger.elastic_origin) + from_contacts;
  ledger.widest = std::max(ledger.widest, std::abs(ledger.unexplained()));
  ledger.turnover = std::max({ledger.turnover, ledger.kinetic, ledger.elastic, std::abs(ledger.potential()), f.friction,
                              ledger.damping(), std::abs(f.stiffening), std::abs(ledger.external())});
}

}  // namespace voussoir
