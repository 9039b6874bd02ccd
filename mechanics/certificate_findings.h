/// The worst violation of each check of a certificate. Internal to the mechanics layer.
#pragma once

#include <cmath>

#include "mechanics/certificate_evidence.h"

namespace prehensile {

/// Of a `Certificate` or a `SpatialCertificate`.
template <class AnyCertificate>
class Findings {
 public:
  Findings() {
    for (CertificateEntry& entry : entries_) entry = {0.0, -1};
  }

  /// A value that is not a number is the worst of all.
  void note(typename AnyCertificate::Check check, double value, int index) {
    CertificateEntry& entry = entries_[check];
    if (std::isnan(entry.value)) return;
    if (std::isnan(value) || value > entry.value) entry = {value, index};
  }

  AnyCertificate certificate() const {
    AnyCertificate result;
    result.entries = entries_;
    result.worst = 0.0;
    for (const CertificateEntry& entry : entries_) {
      result.worst = worse(entry.value, result.worst);
    }
    return result;
  }

 private:
  decltype(AnyCertificate::entries) entries_;
};

}  // namespace prehensile
