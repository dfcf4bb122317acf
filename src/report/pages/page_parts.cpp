// SPDX-License-Identifier: MIT
#include "page_parts.hpp"

namespace lacuna {

std::string page_style() {
  return R"(*{box-sizing:border-box}
:root{--good:#1a7f37;--doubtful:#9a6700;--bad:#cf222e;--card:#f5f7f9;--new:#0072b2}
@media (prefers-color-scheme:dark){:root{--good:#4cc46a;--doubtful:#e3b341;--bad:#ff7b72;
--card:#1d2228;--new:#5cb8f5}}
@media print{:root{--good:#1a7f37;--doubtful:#9a6700;--bad:#cf222e;--card:#f5f7f9;--new:#0072b2}}
body{margin:0;background:var(--paper);color:var(--ink);
font:16px/1.5 system-ui,"Segoe UI","Liberation Sans",sans-serif}
main,footer{max-width:64rem;margin:0 auto;padding:1rem 1.2rem}
h1{font-size:1.6rem;line-height:1.25;margin:.2rem 0 .8rem}
h1.good{color:var(--good)}h1.doubtful{color:var(--doubtful)}h1.bad{color:var(--bad)}
h2{font-size:1.15rem;margin:2.2rem 0 .6rem;border-bottom:1px solid var(--grid);
padding-bottom:.25rem}
.kind{color:var(--soft);margin:0;overflow-wrap:anywhere}
.finding{margin:.35rem 0;overflow-wrap:anywhere}
.facts{display:grid;grid-template-columns:repeat(auto-fit,minmax(10.5rem,1fr));gap:.7rem;
margin:1.1rem 0}
.fact{background:var(--card);border-radius:8px;padding:.6rem .8rem;overflow-wrap:anywhere}
.fact dt{color:var(--soft);font-size:.8rem}.fact dd{margin:0}
.fact .value{font-size:1.25rem;font-weight:600}.fact .note{color:var(--soft);font-size:.8rem}
.equations{overflow-x:auto;padding:.4rem 0;font-size:1.1rem}
.equation{display:flex;align-items:baseline;gap:.35em;margin:.5em 0}
.terms{flex:1;min-width:0;line-height:1.9}.term{display:inline-block;max-width:100%}
.term.new{display:block;color:var(--new);font-weight:600}
figure{margin:.8rem 0;overflow-x:auto}
figure svg{display:block;width:100%;min-width:560px;max-width:60rem;height:auto}
figure .narrow{display:none;min-width:0}
@media screen and (max-width:600px){.equation{display:block}.terms{padding-left:1.2em}
figure svg:has(+.narrow){display:none}figure .narrow{display:block}}
.wide{overflow-x:auto}.wide table{min-width:34rem}table{border-collapse:collapse;font-size:.9rem}
th,td{text-align:left;padding:.25rem .8rem .25rem 0;border-bottom:1px solid var(--grid);
vertical-align:top}
th{color:var(--soft);font-weight:600}.number{text-align:right;white-space:nowrap;
font-variant-numeric:tabular-nums}
@media screen and (max-width:600px){.wide table{min-width:0;font-size:.8rem}
th,td{padding-right:.45rem}td{overflow-wrap:anywhere}.number{white-space:normal}}
details{margin:1.4rem 0;border-top:1px solid var(--grid);padding-top:.8rem}
summary{cursor:pointer;font-weight:600}
code{font:.85em ui-monospace,"Liberation Mono",monospace;overflow-wrap:anywhere}
footer{color:var(--soft);font-size:.85rem;margin-top:2rem}
.tip{position:fixed;pointer-events:none;background:var(--ink);color:var(--paper);
font-size:.78rem;padding:.2rem .5rem;border-radius:5px;white-space:pre;display:none;z-index:2}
.orbit{cursor:grab;touch-action:pan-y}
@media print{details{display:block}details>*{display:block}figure{break-inside:avoid}
figure svg{min-width:0}.tip{display:none}}
)";
}

std::string page_script() {
  return R"((function(){'use strict';
function each(root,what,act){Array.prototype.forEach.call(root.querySelectorAll(what),act);}
function toggle(key){var svg=key.closest('svg'),off=key.classList.toggle('off');
each(svg,'path[data-series="'+key.dataset.series+'"]',function(p){
p.style.display=off?'none':'';});}
each(document,'.key',function(key){
key.addEventListener('click',function(){toggle(key);});
key.addEventListener('keydown',function(e){
if(e.key==='Enter'||e.key===' '){e.preventDefault();toggle(key);}});});
var tip=document.createElement('div');tip.className='tip';document.body.appendChild(tip);
function at(scale,part){var s=scale.split(' '),a=+s[0],b=+s[1];
return s[2]?a*Math.pow(b/a,part):a+part*(b-a);}
function points(path){if(!path.points){path.points=[];
(path.getAttribute('d').match(/-?[\d.]+,-?[\d.]+/g)||[]).forEach(function(t){
var c=t.split(',');path.points.push([+c[0],+c[1]]);});}return path.points;}
function nearest(plot,x,y){var best=null,least=900;each(plot,'path',function(path){
if(path.style.display==='none')return;points(path).forEach(function(p){
var d=(p[0]-x)*(p[0]-x)+(p[1]-y)*(p[1]-y);if(d<least){least=d;best=[p,path];}});});
return best;}
each(document,'.lines',function(svg){svg.addEventListener('pointermove',function(e){
var plot=svg.querySelector('.plot'),r=svg.getBoundingClientRect(),v=svg.viewBox.baseVal;
var x=(e.clientX-r.left)/r.width*v.width,y=(e.clientY-r.top)/r.height*v.height;
var found=nearest(plot,x,y);if(!found){tip.style.display='none';return;}
var b=plot.dataset.box.split(' ').map(Number),p=found[0];
tip.textContent=found[1].dataset.label+'\n'+plot.dataset.xlabel+': '+
at(plot.dataset.x,(p[0]-b[0])/b[2]).toPrecision(5)+'\n'+plot.dataset.ylabel+': '+
at(plot.dataset.y,1-(p[1]-b[1])/b[3]).toPrecision(4);
tip.style.display='block';
tip.style.left=Math.min(e.clientX+14,window.innerWidth-tip.offsetWidth-8)+'px';
tip.style.top=(e.clientY+14)+'px';});
svg.addEventListener('pointerleave',function(){tip.style.display='none';});});
each(document,'.orbit',function(svg){
var turn=0.7,tilt=0.45,v=svg.viewBox.baseVal,top=30,curves=[];
var scale=0.31*Math.min(v.height-top,v.width-40)/1000;each(svg,'path[data-points]',function(path){
curves.push([path,path.dataset.points.split(' ').map(function(t){
return t==='-'?null:t.split(',').map(Number);})]);});
function seen(p){var x=p[0]*Math.cos(turn)-p[1]*Math.sin(turn);
var d=p[0]*Math.sin(turn)+p[1]*Math.cos(turn),y=p[2]*Math.cos(tilt)+d*Math.sin(tilt);
return [v.width/2+scale*x,top+(v.height-top)/2-scale*y];}
function show(){curves.forEach(function(c){var open=false,d='';c[1].forEach(function(p){
if(!p){open=false;return;}var s=seen(p);
d+=(open?' ':'M')+s[0].toFixed(1)+','+s[1].toFixed(1);open=true;});
c[0].setAttribute('d',d);});
each(svg,'.spatial',function(g){var end=[-1000,-1000,-1000];end[+g.dataset.axis]=1100;
var a=seen([-1000,-1000,-1000]),b=seen(end),l=g.querySelector('line'),t=g.querySelector('text');
l.setAttribute('x1',a[0]);l.setAttribute('y1',a[1]);l.setAttribute('x2',b[0]);
l.setAttribute('y2',b[1]);t.setAttribute('x',b[0]);t.setAttribute('y',b[1]-4);});}
function move(round,up){turn+=round;tilt=Math.max(-1.5,Math.min(1.5,tilt+up));show();}
var arrows={ArrowLeft:[-0.1,0],ArrowRight:[0.1,0],ArrowUp:[0,-0.1],ArrowDown:[0,0.1]};
svg.tabIndex=0;svg.addEventListener('keydown',function(e){var by=arrows[e.key];
if(by&&e.target===svg){e.preventDefault();move(by[0],by[1]);}});
var from=null;svg.addEventListener('pointerdown',function(e){
if(e.target.closest('.key'))return;from=[e.clientX,e.clientY];svg.setPointerCapture(e.pointerId);});
svg.addEventListener('pointermove',function(e){if(!from)return;
move((e.clientX-from[0])*0.01,(e.clientY-from[1])*0.01);from=[e.clientX,e.clientY];});
svg.addEventListener('pointerup',function(){from=null;});});
})();
)";
}

}  // namespace lacuna
