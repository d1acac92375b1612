#include "tools/metrics/mot_json.hpp"

#include <nlohmann/json.hpp>

namespace ghtrack {

void add_mot(nlohmann::ordered_json& json, const MotResult& result) {
  const ClearMotResult& clear = result.clear;
  json["mota"] = clear.mota;
  json["motp"] = clear.motp;
  json["id_switches"] = clear.id_switches;
  json["fragmentations"] = clear.fragmentations;
  json["mota_adjacent"] = clear.mota_adjacent;
  json["id_switches_adjacent"] = clear.id_switches_adjacent;
  json["matches"] = clear.matches;
  json["misses"] = clear.misses;
  json["false_positives"] = clear.false_tracks;
  json["recall"] = clear.recall;
  json["precision"] = clear.precision;
  json["mostly_tracked"] = clear.mostly_tracked;
  json["partially_tracked"] = clear.partially_tracked;
  json["mostly_lost"] = clear.mostly_lost;
  json["idf1"] = result.identity.idf1;
  json["idp"] = result.identity.idp;
  json["idr"] = result.identity.idr;
  json["hota"] = result.hota.hota;
  json["deta"] = result.hota.deta;
  json["assa"] = result.hota.assa;
  json["loca"] = result.hota.loca;
  json["ospa2"] = result.ospa2 ? nlohmann::ordered_json(*result.ospa2) : nullptr;
}

}  // namespace ghtrack
