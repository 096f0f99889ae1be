#!/bin/sh
# Writes reference_systems.cpp from the database of PROJ (Debian: apt install proj-data sqlite3):
#   app/import/reference_systems.sh /usr/share/proj/proj.db > app/import/reference_systems.cpp
# EPSG's systems and ESRI's: code, kind and unit of the axes in the plane. A compound system is that of its plane. A
# system that PROJ holds as text (ESRI's) ends with its unit.
set -eu
database=${1:-/usr/share/proj/proj.db}
package=$(dpkg-query -W -f '${Version}' proj-data 2>/dev/null || echo unknown)
epsg=$(sqlite3 "$database" "select value from metadata where key = 'EPSG.VERSION'")

cat <<END
// Made by reference_systems.sh from proj.db of Debian's package proj-data $package (EPSG $epsg); do not edit.
#include "app/import/reference_systems.hpp"

namespace voussoir {

// clang-format off
extern const SystemGroup system_groups[] = {
END

sqlite3 -separator '|' "$database" "
with plane_units as (
  select a.coordinate_system_auth_name as authority, a.coordinate_system_code as system, min(u.name) as unit,
         min(u.conv_factor) as metres
  from axis a join unit_of_measure u on u.auth_name = a.uom_auth_name and u.code = a.uom_code
  where a.coordinate_system_order < 3 group by 1, 2),
plane as (
  select auth_name, code, case when type like 'geographic%' then 'geographic' else 'geocentric' end as kind,
         '' as unit, '0' as metres from geodetic_crs
  union all
  select p.auth_name, p.code, 'projected',
         coalesce(u.unit, case
           when p.text_definition like '%UNIT[\"Meter\",1.0]]' then 'metre'
           when p.text_definition like '%UNIT[\"Foot_US\",0.3048006096012192]]' then 'US survey foot'
           else replace(replace(substr(p.text_definition, -27), '\"', ''), ']', '') end),
         coalesce(u.metres, case
           when p.text_definition like '%UNIT[\"Meter\",1.0]]' then 1.0
           when p.text_definition like '%UNIT[\"Foot_US\",0.3048006096012192]]' then 0.304800609601219 else 0 end)
  from projected_crs p left join plane_units u
    on u.authority = p.coordinate_system_auth_name and u.system = p.coordinate_system_code)
select auth_name, kind, unit, metres, code from plane where auth_name in ('EPSG', 'ESRI')
union
select c.auth_name, h.kind, h.unit, h.metres, c.code from compound_crs c join plane h
  on h.auth_name = c.horiz_crs_auth_name and h.code = c.horiz_crs_code where c.auth_name in ('EPSG', 'ESRI')" |
  awk -F '|' '$4 != 0 || $2 != "projected"' | sort -t '|' -k 1,4 -k 5,5n | awk -F '|' '
    function close_run() { if (first != "") text = text (text == "" ? "" : " ") (first == last ? first : first "-" last) }
    function close_group(    at, line) {
      close_run()
      if (text != "") {
        printf "    {\"%s\", SystemKind::%s, {\"%s\", %s},", authority, kind, unit, metres
        while (length(text) > 100) {
          at = 100
          while (substr(text, at, 1) != " ") --at
          printf "\n     \"%s\"", substr(text, 1, at)
          text = substr(text, at + 1)
        }
        printf "\n     \"%s\"},\n", text
      }
      text = ""; first = ""
    }
    {
      key = $1 "|" $2 "|" $3 "|" $4
      if (key != group) {
        close_group()
        group = key; authority = $1; kind = $2; unit = $3; metres = $4
      }
      if (first == "") first = last = $5
      else if ($5 == last + 1) last = $5
      else { close_run(); first = last = $5 }
    }
    END { close_group() }'

cat <<END
};
// clang-format on

extern const std::size_t system_group_count = std::size(system_groups);

}  // namespace voussoir
END
